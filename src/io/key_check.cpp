#include "ppf_bin_picking/io/key_check.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>
#include <numeric>

namespace ppf_bin_picking
{
namespace
{
/// Levenshtein distance.
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}
}  // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& names)
{
  const auto nearest = std::min_element(names.begin(), names.end(),
                                        [&](const std::string& a, const std::string& b)
                                        { return editDistance(word, a) < editDistance(word, b); });
  return nearest == names.end() ? std::string() : *nearest;
}

void requireKnownKey(const std::string& where, const std::string& key,
                     const std::vector<std::string>& names)
{
  if (std::find(names.begin(), names.end(), key) != names.end()) return;
  const std::string nearest = nearestName(key, names);
  throw InputError(
      where + ": unknown key '" + key + "'" +
      (nearest.empty() ? ": remove it" : ": the nearest known name is '" + nearest + "'"));
}

void wrongType(const std::string& where, const std::string& key, const std::string& value,
               const std::string& expected)
{
  throw InputError(where + ": " + key + " is " + value + ": give " + expected);
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/io/key_check.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>
#include <cstddef>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxListedNames = 12;
constexpr std::size_t kMinBeginning = 4;  // letters that two names have in common

/// Letters to insert, delete, replace or exchange with their neighbour (optimal string alignment).
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      if (i == 0 || j == 0)
      {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({replaced, d[i - 1][j] + 1, d[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

/// The first name that begins with a word, or with which the word begins; empty if there is none.
std::string nameBegunBy(const std::string& word, const std::vector<std::string>& names)
{
  const auto is_begun = [&](const std::string& name)
  {
    const std::size_t shorter = std::min(word.size(), name.size());
    return shorter >= kMinBeginning && word.compare(0, shorter, name, 0, shorter) == 0;
  };
  const auto found = std::find_if(names.begin(), names.end(), is_begun);
  return found == names.end() ? std::string() : *found;
}

std::string remedyFor(const std::string& key, const std::vector<std::string>& names)
{
  if (names.empty()) return "remove it";
  const std::string similar = similarName(key, names);
  if (!similar.empty()) return "the nearest known name is '" + similar + "'";
  if (names.size() > kMaxListedNames)
    return "no known name is like it; remove it, or check that this is the file you mean";
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return "known are " + list;
}
}  // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& names)
{
  const auto nearest = std::min_element(names.begin(), names.end(),
                                        [&](const std::string& a, const std::string& b)
                                        { return editDistance(word, a) < editDistance(word, b); });
  return nearest == names.end() ? std::string() : *nearest;
}

std::string similarName(const std::string& word, const std::vector<std::string>& names)
{
  const std::string nearest = nearestName(word, names);
  const std::size_t limit = std::max(word.size(), nearest.size()) / 3;
  return editDistance(word, nearest) <= limit ? nearest : nameBegunBy(word, names);
}

void requireKnownKey(const std::string& where, const std::string& key,
                     const std::vector<std::string>& names)
{
  if (std::find(names.begin(), names.end(), key) != names.end()) return;
  throw InputError(where + ": unknown key '" + key + "': " + remedyFor(key, names));
}

void wrongType(const std::string& where, const std::string& key, const std::string& value,
               const std::string& expected)
{
  throw InputError(where + ": " + key + " is " + value + ": give " + expected);
}
}  // namespace ppf_bin_picking

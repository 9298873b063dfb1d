#include "stl_tidy.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetsAt = 84;
constexpr std::size_t kFacetBytes = 50;

std::uint32_t facetCounter(const std::string& bytes)
{
  std::uint32_t counter = 0;
  std::memcpy(&counter, bytes.data() + kHeaderBytes, sizeof counter);
  return counter;
}

bool beginsWithSolid(const std::string& bytes)
{
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string::npos && bytes.compare(first, 5, "solid") == 0;
}

TidyStl tidyBinary(const std::string& bytes)
{
  TidyStl tidy;
  const std::size_t counted = facetCounter(bytes);
  const std::size_t held = (bytes.size() - kFacetsAt) / kFacetBytes;
  const std::size_t rest = (bytes.size() - kFacetsAt) % kFacetBytes;
  const bool has_trailer = counted <= held && rest != 0;  // some writers append their own data
  tidy.facets = has_trailer ? counted : held;
  if (beginsWithSolid(bytes))
    tidy.oddities.emplace_back("is binary although its header begins with 'solid'");
  if (has_trailer)
    tidy.oddities.push_back("has " +
                            std::to_string(bytes.size() - kFacetsAt - counted * kFacetBytes) +
                            " bytes after its last facet, which are ignored");
  else if (counted != held || rest != 0)
    tidy.loss = "its header counts " + std::to_string(counted) + " facets but it holds " +
                std::to_string(held);
  tidy.bytes = std::string(kHeaderBytes, '\0');
  const auto counter = static_cast<std::uint32_t>(tidy.facets);
  tidy.bytes.append(reinterpret_cast<const char*>(&counter), sizeof counter);
  tidy.bytes.append(bytes, kFacetsAt, tidy.facets * kFacetBytes);
  return tidy;
}

/// True for what looks like a number in lower case; the importer reads it. No strtod: it depends on
/// the locale.
bool isNumber(const std::string& word)
{
  if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos) return true;
  return word.find_first_of("0123456789") != std::string::npos &&
         word.find_first_not_of("+-.e0123456789") == std::string::npos;
}

/// Reads text STL facet by facet.
class TextStl
{
public:
  explicit TextStl(const std::string& bytes) : bytes_(bytes) {}

  TidyStl tidy()
  {
    tidy_.bytes = "solid tidy\n";
    for (std::string word = next(); !word.empty(); word = next())
      take(word);
    if (in_facet_) endFacet();
    if (!solid_ended_) note(tidy_.loss, "it has no 'endsolid' line at its end");
    if (lost_ > 0) note(tidy_.loss, std::to_string(lost_) + " of its facets lack a corner");
    if (!strange_.empty()) note(tidy_.loss, "STL does not know its word '" + strange_ + "'");
    if (polygons_ > 0)
      tidy_.oddities.push_back("has more than three corners in " + std::to_string(polygons_) +
                               " of its facets; they are split");
    tidy_.bytes += "endsolid tidy\n";
    return std::move(tidy_);
  }

private:
  static void note(std::string& text, const std::string& more)
  {
    text += (text.empty() ? "" : " and ") + more;
  }

  /// The next word in lower case; empty at the end.
  std::string next()
  {
    const char* const space = " \t\r\n";
    const std::size_t begin = std::min(bytes_.find_first_not_of(space, at_), bytes_.size());
    at_ = std::min(bytes_.find_first_of(space, begin), bytes_.size());
    std::string word = bytes_.substr(begin, at_ - begin);
    for (char& letter : word)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return word;
  }

  std::string restOfLine()
  {
    const std::size_t end = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
    std::string rest = bytes_.substr(at_, end - at_);
    at_ = end;
    rest.erase(0, std::min(rest.find_first_not_of(" \t"), rest.size()));
    rest.erase(rest.find_last_not_of(" \t") + 1);
    return rest;
  }

  /// The next three words, if they are numbers; stops before the first that is not.
  std::vector<std::string> nextNumbers()
  {
    std::vector<std::string> numbers;
    while (numbers.size() < 3)
    {
      const std::size_t before = at_;
      numbers.push_back(next());
      if (isNumber(numbers.back())) continue;
      at_ = before;
      numbers.pop_back();
      break;
    }
    return numbers;
  }

  void take(const std::string& word)
  {
    if (word == "solid")
      beginSolid();
    else if (word == "endsolid")
      endSolid();
    else if (word == "facet")
      beginFacet();
    else if (word == "normal")
      normal_ = nextNumbers();
    else if (word == "vertex")
      corners_.push_back(nextNumbers());
    else if (word == "endfacet")
      endFacet();
    else if (word != "outer" && word != "loop" && word != "endloop" && strange_.empty())
      strange_ = word.substr(0, 20);
  }

  void beginSolid()
  {
    name_ = restOfLine();
    solid_ended_ = false;
  }

  void endSolid()
  {
    const std::string name = restOfLine();
    solid_ended_ = true;
    if (!name.empty() && name != name_ && tidy_.oddities.empty())
      tidy_.oddities.push_back("begins the solid '" + name_ + "' and ends '" + name + "'");
  }

  void beginFacet()
  {
    if (in_facet_) endFacet();
    in_facet_ = true;
  }

  void endFacet()
  {
    const bool whole =
        corners_.size() >= 3 && std::all_of(corners_.begin(), corners_.end(),
                                            [](const auto& corner) { return corner.size() == 3; });
    if (!whole) ++lost_;
    if (whole && corners_.size() > 3) ++polygons_;
    for (std::size_t k = 2; whole && k < corners_.size(); ++k)
      writeTriangle({corners_[0], corners_[k - 1], corners_[k]});
    in_facet_ = false;
    normal_.clear();
    corners_.clear();
  }

  void writeTriangle(const std::array<std::vector<std::string>, 3>& corners)
  {
    const auto write = [&](const char* keyword, const std::vector<std::string>& n)
    { tidy_.bytes += keyword + n[0] + " " + n[1] + " " + n[2] + "\n"; };
    const std::vector<std::string> none = {"0", "0", "0"};
    write("facet normal ", normal_.size() == 3 ? normal_ : none);
    tidy_.bytes += "outer loop\n";
    for (const std::vector<std::string>& corner : corners)
      write("vertex ", corner);
    tidy_.bytes += "endloop\nendfacet\n";
    ++tidy_.facets;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  TidyStl tidy_;
  std::string name_;
  std::string strange_;
  bool solid_ended_ = false;
  bool in_facet_ = false;
  std::vector<std::string> normal_;
  std::vector<std::vector<std::string>> corners_;
  std::size_t lost_ = 0;
  std::size_t polygons_ = 0;
};
}  // namespace

TidyStl tidyStl(const std::string& bytes)
{
  const bool has_counter = bytes.size() >= kFacetsAt;
  const bool counter_fits =
      has_counter && kFacetsAt + kFacetBytes * std::size_t{facetCounter(bytes)} == bytes.size();
  const bool text = beginsWithSolid(bytes) && bytes.find('\0') == std::string::npos;
  if (text && !counter_fits) return TextStl(bytes).tidy();
  if (has_counter) return tidyBinary(bytes);
  TidyStl none;
  none.loss =
      bytes.empty() ? "it is empty" : "it begins neither like a text nor like a binary STL file";
  return none;
}
}  // namespace ppf_bin_picking

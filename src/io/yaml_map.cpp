#include "ppf_bin_picking/io/yaml_map.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/key_check.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxYamlBytes = 1 << 20;

/// The value as a person sees it in the file.
std::string shown(const YAML::Node& node)
{
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a mapping";
  if (!node.IsScalar()) return "empty";
  return "'" + node.Scalar().substr(0, 60) + "'";
}

/// A scalar without quotes or tag; nodes made by a program carry no tag at all.
bool isPlain(const YAML::Node& node)
{
  return node.IsScalar() && (node.Tag().empty() || node.Tag() == "?");
}

std::optional<double> plainNumber(const YAML::Node& node)
{
  static const std::regex form(R"([-+]?(0|[1-9][0-9]*)(\.[0-9]*([eE][-+][0-9]+)?)?)");
  if (!isPlain(node) || node.Scalar().size() > 60 || !std::regex_match(node.Scalar(), form))
    return std::nullopt;
  std::istringstream stream(node.Scalar());
  stream.imbue(std::locale::classic());
  double value = 0;
  if (!(stream >> value) || !std::isfinite(value)) return std::nullopt;
  return value;
}
}  // namespace

YAML::Node loadYaml(const std::string& path)
{
  const std::string text = readFile(path, kMaxYamlBytes);
  try
  {
    return YAML::Load(text);
  }
  catch (const YAML::Exception& error)
  {
    std::string reason = error.msg;  // may quote the file
    std::replace_if(
        reason.begin(), reason.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
    throw InputError(path + ": line " + std::to_string(error.mark.line + 1) +
                     " is not valid YAML (" + reason + "): mend it");
  }
}

YamlMap::YamlMap(const YAML::Node& node, std::string where, std::vector<std::string> keys)
    : node_(node), where_(std::move(where)), keys_(std::move(keys))
{
  if (!node_.IsMap())
    throw InputError(where_ + " is " + shown(node_) + ": give 'key: value' lines");
  std::set<std::string> seen;
  for (const auto& item : node_)
  {
    const std::string key = item.first.IsScalar() ? item.first.Scalar() : shown(item.first);
    requireKnownKey(where_, key, keys_);
    if (!seen.insert(key).second)
      throw InputError(where_ + ": " + key + " stands there twice: remove one");
  }
}

bool YamlMap::has(const std::string& key) const
{
  return node_[key].IsDefined();
}

YAML::Node YamlMap::node(const std::string& key) const
{
  if (!has(key)) throw InputError(where_ + ": " + key + " is missing: add it");
  return node_[key];
}

double YamlMap::number(const std::string& key) const
{
  const YAML::Node value = node(key);
  const std::optional<double> number = plainNumber(value);
  if (!number) wrongType(where_, key, shown(value), kExpectedNumber);
  return *number;
}

int YamlMap::integer(const std::string& key) const
{
  const YAML::Node value = node(key);
  const std::optional<double> number = plainNumber(value);
  const double limit = std::numeric_limits<int>::max();
  if (!number || value.Scalar().find('.') != std::string::npos || std::abs(*number) > limit)
    wrongType(where_, key, shown(value), kExpectedInteger);
  return static_cast<int>(*number);
}

bool YamlMap::boolean(const std::string& key) const
{
  const YAML::Node value = node(key);
  bool result = false;
  const bool one_letter = value.IsScalar() && value.Scalar().size() == 1;  // a text to rosparam
  if (!isPlain(value) || one_letter || !YAML::convert<bool>::decode(value, result))
    wrongType(where_, key, shown(value), kExpectedBoolean);
  return result;
}

std::string YamlMap::text(const std::string& key) const
{
  const YAML::Node value = node(key);
  if (!value.IsScalar() || value.Scalar().empty())
    wrongType(where_, key, value.IsScalar() ? "empty" : shown(value), kExpectedText);
  return value.Scalar();
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t count) const
{
  const YAML::Node list = node(key);
  const std::string expected = "a list of " + std::to_string(count) + " numbers";
  if (!list.IsSequence()) wrongType(where_, key, shown(list), expected);
  if (list.size() != count)
    wrongType(where_, key, "a list of " + std::to_string(list.size()), expected);
  std::vector<double> values;
  for (const YAML::Node& item : list)
  {
    const std::optional<double> number = plainNumber(item);
    if (!number)
      wrongType(where_, key + "[" + std::to_string(values.size()) + "]", shown(item),
                kExpectedNumber);
    values.push_back(*number);
  }
  return values;
}

YamlMap YamlMap::map(const std::string& key, std::vector<std::string> keys) const
{
  return {node(key), where_ + ": " + key, std::move(keys)};
}

std::vector<YamlMap> YamlMap::maps(const std::string& key,
                                   const std::vector<std::string>& keys) const
{
  if (!has(key)) return {};
  const YAML::Node list = node(key);
  if (!list.IsSequence()) wrongType(where_, key, shown(list), "a list of mappings");
  std::vector<YamlMap> maps;
  for (const YAML::Node& item : list)
    maps.emplace_back(item, where_ + ": " + key + "[" + std::to_string(maps.size()) + "]", keys);
  return maps;
}

std::string plainDecimal(double value)
{
  for (int digits = 0; digits < 340; ++digits)
  {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream << std::fixed << std::setprecision(digits) << value;
    std::istringstream back(stream.str());
    back.imbue(std::locale::classic());
    double read = 0;
    if (back >> read && read == value) return stream.str();
  }
  throw std::invalid_argument("a number that is not finite has no decimal form");
}
}  // namespace ppf_bin_picking

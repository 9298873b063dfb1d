#include "ppf_bin_picking/ros/params.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/key_check.hpp"
#include "ppf_bin_picking/io/package_path.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectorConfig;
using ppf_bin_picking::InputError;
using ppf_bin_picking::YamlMap;
using XmlRpc::XmlRpcValue;

/// `diagnostic_period` is read by diagnostic_updater.
const std::vector<std::string> kKeys = {
    "detector",           "parts",        "output_frame",     "timeout_s", "max_poses",
    "region_of_interest", "tf_timeout_s", "diagnostic_period"};

constexpr double kHour_s = 3600.0;

YAML::Node quoted(const std::string& text)
{
  YAML::Node node(text);
  node.SetTag("!");  // what YAML's parser gives to a text in quotes
  return node;
}

/// Always with a point, so that 30.0 is not taken for an integer.
YAML::Node decimal(const double value)
{
  if (!std::isfinite(value)) return quoted(std::to_string(value));
  const std::string text = ppf_bin_picking::plainDecimal(value);
  return YAML::Node(text.find('.') == std::string::npos ? text + ".0" : text);
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines)
    text += (text.empty() ? "" : "\n") + line;
  return text;
}

double numberWithin(const YamlMap& map, const std::string& key, const double low, const double high)
{
  const double value = map.number(key);
  if (value >= low && value <= high) return value;
  throw InputError(map.where() + ": " + key + " is " + ppf_bin_picking::plainDecimal(value) +
                   ": give a value from " + ppf_bin_picking::plainDecimal(low) + " to " +
                   ppf_bin_picking::plainDecimal(high));
}

int countOrZero(const YamlMap& map, const std::string& key)
{
  const int value = map.integer(key);
  if (value >= 0) return value;
  throw InputError(map.where() + ": " + key + " is " + std::to_string(value) +
                   ": give 0 for all, or a number above");
}

/// An empty text is allowed, unlike YamlMap::text().
std::string textOrEmpty(const YamlMap& map, const std::string& key)
{
  const YAML::Node node = map.node(key);
  return node.IsScalar() && node.Scalar().empty() ? std::string() : map.text(key);
}

/// @param text  An absolute path, or package://name/path.
std::string partFile(const std::string& text, const std::string& where)
{
  if (text.front() == '/') return text;
  if (ppf_bin_picking::isPackagePath(text))
    return ppf_bin_picking::resolvedPackagePath(text, where);
  throw InputError(where + " is '" + text + "': give an absolute path, or package://name/path");
}

std::vector<std::string> readParts(const YamlMap& map)
{
  const std::string remedy = ": give a part file, or a list of them";
  if (!map.has("parts")) throw InputError(map.where() + ": parts is missing" + remedy);
  const YAML::Node node = map.node("parts");
  if (node.IsScalar()) return {partFile(map.text("parts"), map.where() + ": parts")};
  if (!node.IsSequence() || node.size() == 0)
    throw InputError(map.where() + ": parts is empty or no list" + remedy);
  std::vector<std::string> parts;
  for (const YAML::Node& item : node)
  {
    const std::string where = map.where() + ": parts[" + std::to_string(parts.size()) + "]";
    if (!item.IsScalar() || item.Tag() != "!" || item.Scalar().empty())
      throw InputError(where + " is no text" + remedy);
    parts.push_back(partFile(item.Scalar(), where));
  }
  return parts;
}

/// Calls each reader and keeps what it complains about, so that a person sees all problems at once.
class Problems
{
public:
  template <class Read>
  void collect(const Read& read)
  {
    try
    {
      read();
    }
    catch (const InputError& error)
    {
      list_.emplace_back(error.what());
    }
  }

  void throwIfAny() const
  {
    if (!list_.empty()) throw ParamError(list_);
  }

private:
  std::vector<std::string> list_;
};

/// The known keys of a tree; the others are problems.
YamlMap knownKeys(const YAML::Node& tree, const std::string& where, Problems& problems)
{
  YAML::Node known(YAML::NodeType::Map);
  for (const auto& item : tree)
    problems.collect(
        [&]
        {
          ppf_bin_picking::requireKnownKey(where, item.first.Scalar(), kKeys);
          known[item.first.Scalar()] = item.second;
        });
  return YamlMap(known, where, kKeys);
}

/// Setting by setting, so that each has its own problem.
DetectorConfig readDetector(const YAML::Node& settings, const std::string& where,
                            Problems& problems)
{
  DetectorConfig config;
  if (!settings.IsMap()) return ppf_bin_picking::withSettings(config, settings, where);
  for (const auto& item : settings)
    problems.collect(
        [&]
        {
          YAML::Node one(YAML::NodeType::Map);
          one[item.first.Scalar()] = item.second;
          config = ppf_bin_picking::withSettings(config, one, where);
        });
  return config;
}
}  // namespace

ParamError::ParamError(std::vector<std::string> problems)
    : std::runtime_error(joined(problems)), problems_(std::move(problems))
{
}

YAML::Node toYaml(const XmlRpcValue& value)
{
  XmlRpcValue copy(value);  // its getters are not const
  switch (copy.getType())
  {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(copy) ? "true" : "false");
    case XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(copy)));
    case XmlRpcValue::TypeDouble:
      return decimal(static_cast<double>(copy));
    case XmlRpcValue::TypeString:
      return quoted(static_cast<std::string>(copy));
    case XmlRpcValue::TypeArray:
    {
      YAML::Node list(YAML::NodeType::Sequence);
      for (int i = 0; i < copy.size(); ++i)
        list.push_back(toYaml(copy[i]));
      return list;
    }
    case XmlRpcValue::TypeStruct:
    {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& item : copy)
        map[item.first] = toYaml(item.second);
      return map;
    }
    default:
      return YAML::Node(YAML::NodeType::Null);
  }
}

ServerParams readServerParams(const XmlRpcValue& tree, const std::string& where)
{
  ServerParams params;
  Problems problems;
  const YAML::Node root = tree.valid() ? toYaml(tree) : YAML::Node(YAML::NodeType::Map);
  const YamlMap map = knownKeys(root, where, problems);
  const auto ifGiven = [&](const char* key, const auto& read)
  {
    if (map.has(key)) problems.collect([&] { read(key); });
  };
  const auto below = [&](const char* key) { return where + "/" + key; };
  problems.collect([&] { params.parts = readParts(map); });
  ifGiven("detector", [&](const char* key)
          { params.detector = readDetector(map.node(key), below(key), problems); });
  ifGiven("region_of_interest", [&](const char* key)
          { params.region_of_interest = ppf_bin_picking::readRegion(map.node(key), below(key)); });
  ifGiven("output_frame", [&](const char* key) { params.output_frame = textOrEmpty(map, key); });
  ifGiven("timeout_s",
          [&](const char* key) { params.timeout_s = numberWithin(map, key, 0.001, kHour_s); });
  ifGiven("tf_timeout_s",
          [&](const char* key) { params.tf_timeout_s = numberWithin(map, key, 0.0, kHour_s); });
  ifGiven("max_poses", [&](const char* key) { params.max_poses = countOrZero(map, key); });
  ifGiven("diagnostic_period", [&](const char* key) { numberWithin(map, key, 0.1, kHour_s); });
  problems.throwIfAny();
  return params;
}
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/io/config_io.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/rigid_pose.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include <cmath>
#include <type_traits>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMaxRegion_m = 50.0;  // no cell is larger: its numbers are millimetres

void readField(const YamlMap& map, const char* key, double& field)
{
  field = map.number(key);
}
void readField(const YamlMap& map, const char* key, int& field)
{
  field = map.integer(key);
}
void readField(const YamlMap& map, const char* key, bool& field)
{
  field = map.boolean(key);
}

void readField(const YamlMap& map, const char* key, Clustering& field)
{
  try
  {
    field = clusteringFromString(map.text(key));
  }
  catch (const std::invalid_argument& error)
  {
    throw InputError(map.where() + ": " + error.what());
  }
}

std::string written(double value)
{
  return plainDecimal(value);
}
std::string written(int value)
{
  return std::to_string(value);
}
std::string written(bool value)
{
  return value ? "true" : "false";
}
std::string written(Clustering value)
{
  return toString(value);
}

Eigen::Vector3d corner(const YamlMap& map, const std::string& key)
{
  return Eigen::Vector3d(map.numbers(key, 3).data());
}
}  // namespace

std::vector<std::string> detectorConfigKeys()
{
  std::vector<std::string> keys;
  visitFields(DetectorConfig(), [&](const char* name, const auto&) { keys.emplace_back(name); });
  return keys;
}

DetectorConfig withSettings(DetectorConfig config, const YAML::Node& settings,
                            const std::string& where)
{
  if (settings.IsNull()) return config;  // a file of comments alone
  const YamlMap map(settings, where, detectorConfigKeys());
  visitFields(config,
              [&](const char* name, auto& field)
              {
                if (map.has(name)) readField(map, name, field);
              });
  std::string problems;
  for (const std::string& problem : config.problems())
    problems += (problems.empty() ? ": " : "; ") + problem;
  if (!problems.empty()) throw InputError(where + problems);
  return config;
}

DetectorConfig loadDetectorConfig(const std::string& path)
{
  const YAML::Node settings = loadYaml(path);
  if (settings.IsMap() &&
      (settings["detector"] || settings["parts"] || settings["region_of_interest"]))
    throw InputError(
        path +
        " holds the parameters of a node; the settings are those below its 'detector': give a "
        "file with the settings at its top, such as config/detector.yaml");
  return withSettings(DetectorConfig(), settings, path);
}

std::string toYaml(const DetectorConfig& config)
{
  std::string text;
  visitFields(config, [&](const char* name, const auto& field)
              { text += std::string(name) + ": " + written(field) + "\n"; });
  return text;
}

Eigen::Isometry3d readPose(const YamlMap& map, const std::string& key)
{
  const std::optional<Eigen::Isometry3d> pose = rigidPose(map.numbers(key, 16));
  if (!pose)
    throw InputError(map.where() + ": " + key +
                     " is not a rotation and a translation: give the 16 numbers of a rigid "
                     "transformation row by row, metres, the last row 0, 0, 0, 1");
  return *pose;
}

FramedRegion readRegion(const YAML::Node& node, const std::string& where)
{
  const YamlMap map(node, where, {"min", "max", "pose", "frame"});
  FramedRegion framed;
  framed.region.min = corner(map, "min");
  framed.region.max = corner(map, "max");
  if (!(framed.region.min.array() < framed.region.max.array()).all())
    throw InputError(where +
                     ": min is not below max: give two opposite corners [m], each of the "
                     "three numbers of min less than that of max");
  if (!(framed.region.diagonal() <= kMaxRegion_m))
    throw InputError(where + ": the box measures " +
                     std::to_string(std::lround(framed.region.diagonal())) +
                     " m across, more than " + std::to_string(std::lround(kMaxRegion_m)) +
                     " m: give its corners in metres");
  if (map.has("pose")) framed.region.T_cloud_box = readPose(map, "pose");
  if (map.has("frame")) framed.frame = map.text("frame");
  return framed;
}

RegionOfInterest loadRegion(const std::string& path)
{
  const FramedRegion framed = readRegion(loadYaml(path), path);
  if (!framed.frame.empty())
    throw InputError(path +
                     ": frame needs tf: give the box in the cloud's frame, if turned with "
                     "its pose, and leave frame out");
  return framed.region;
}
}  // namespace ppf_bin_picking

/// @file Detector settings and regions of interest as YAML.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
class YamlMap;

/// The names of all fields of DetectorConfig, in its order.
std::vector<std::string> detectorConfigKeys();

/// Sets the fields that a YAML mapping names; the others stay.
/// @param where  The file, and the key within it; begins every message.
/// @return The changed configuration, checked.
/// @throw InputError for an unknown key, a value of another type or out of range.
DetectorConfig withSettings(DetectorConfig config, const YAML::Node& settings,
                            const std::string& where);

/// Reads a file like config/detector.yaml; what it leaves out has its default.
/// @throw InputError as withSettings(), and for a node's parameters.
DetectorConfig loadDetectorConfig(const std::string& path);

/// Every field as a `name: value` line.
std::string toYaml(const DetectorConfig& config);

/// A region of interest with the frame that its coordinates are in.
struct FramedRegion
{
  RegionOfInterest region;  ///< T_cloud_box maps to `frame` where that is given.
  std::string frame;        ///< tf name; empty: the cloud's own frame.
};

/// Reads `{min: [x, y, z], max: [x, y, z]}` [m], with `pose: [16 numbers]` (row-major T_cloud_box)
/// if the box has a frame of its own, and `frame`.
/// @throw InputError for an unknown key, a min that is not below max, a pose that is not rigid.
FramedRegion readRegion(const YAML::Node& node, const std::string& where);

/// Reads a region of interest in the cloud's frame from a file.
/// @throw InputError as readRegion(), and if it names a frame, which needs tf.
RegionOfInterest loadRegion(const std::string& path);

/// Reads a rigid transformation, 16 numbers row-major. @throw InputError if it is not rigid.
Eigen::Isometry3d readPose(const YamlMap& map, const std::string& key);
}  // namespace ppf_bin_picking

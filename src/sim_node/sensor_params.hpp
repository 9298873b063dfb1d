/// @file The depth sensor of a simulated cell as YAML. No ROS.
#pragma once

#include "ppf_bin_picking/io/yaml_map.hpp"
#include "ppf_bin_picking/sim/depth_sensor.hpp"

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// `preset` and the names of all fields of DepthSensor: the keys that readDepthSensor() knows.
std::vector<std::string> depthSensorKeys();

/// Reads `preset`, by default `industrial`, and the values that differ from it.
/// @param map  Has the keys of depthSensorKeys().
/// @throw InputError for an unknown preset, a value of another type or out of range.
DepthSensor readDepthSensor(const YamlMap& map);
}  // namespace ppf_bin_picking

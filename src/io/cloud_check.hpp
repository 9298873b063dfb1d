/// @file What every file of points has to pass.
#pragma once

#include "ppf_bin_picking/core/point_cloud.hpp"

#include <cstddef>
#include <string>

namespace ppf_bin_picking
{
/// @throw InputError if a file holds more than max_points points.
void requireAtMost(std::size_t max_points, std::size_t points, const std::string& path);

/// @throw InputError if no point of the cloud is finite.
void requireMeasurement(const PointCloud& cloud, const std::string& path);
}  // namespace ppf_bin_picking

/// @file Point clouds from PCD and PLY files.
#pragma once

#include "ppf_bin_picking/core/point_cloud.hpp"

#include "ppf_bin_picking/io/length_unit.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
struct LoadedCloud
{
  PointCloud cloud;                   ///< [m]; organised, and with normals, where the file is.
  std::vector<std::string> warnings;  ///< One sentence each, naming the file.
};

/// Reads a cloud in the camera's optical frame.
/// @param unit  Of the file's coordinates.
/// @throw InputError if the file is damaged, has no x y z of type float, more than max_points
///        points, or none that is finite.
LoadedCloud loadCloud(const std::string& path, LengthUnit unit, std::size_t max_points);
}  // namespace ppf_bin_picking

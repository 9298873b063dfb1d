/// @file Points in metres, with or without normals, in the order of an image or in none.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// One shot of a depth camera. Coordinates are metres in the camera's optical frame: z forward, the
/// camera at the origin. A point without measurement has a non-finite coordinate (REP-117).
struct PointCloud
{
  std::vector<Eigen::Vector3f> points;   ///< [m]; row after row where the cloud is organised.
  std::vector<Eigen::Vector3f> normals;  ///< Unit length; empty, or as many as points.
  std::size_t width = 0;                 ///< Columns; width * height == points.size().
  std::size_t height = 0;                ///< Rows; above 1 means organised as the camera's image.

  bool organised() const { return height > 1; }
  std::size_t size() const { return points.size(); }
};
}  // namespace ppf_bin_picking

/// @file Points in metres, with or without normals, in the order of an image or in none.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// One shot of a depth camera. Coordinates are metres in the camera's optical frame: z forward, the
/// camera at the origin. A point without measurement has a non-finite coordinate (REP-117), or is
/// zero.
struct PointCloud
{
  std::vector<Eigen::Vector3f> points;   ///< [m]; row after row where the cloud is organised.
  std::vector<Eigen::Vector3f> normals;  ///< Unit length; empty, or as many as points.
  std::size_t width = 0;                 ///< Columns; width * height == points.size().
  std::size_t height = 0;                ///< Rows; above 1 means organised as the camera's image.

  bool organised() const { return height > 1; }
  std::size_t size() const { return points.size(); }
};

/// True for a finite point that a camera can have seen: at least 1 mm in front of it, and not
/// sideways of it (87 degrees off the line of sight).
inline bool measured(const Eigen::Vector3f& p)
{
  return p.allFinite() && p.z() > 1e-3F && std::max(std::abs(p.x()), std::abs(p.y())) < 20 * p.z();
}
}  // namespace ppf_bin_picking

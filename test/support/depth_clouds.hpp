/// @file Clouds whose depth a formula gives, and images of them that keep every pixel.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <limits>

namespace ppf_bin_picking
{
/// The organised cloud of what lies at a depth of each pixel [m]; NaN where that is 0.
inline PointCloud cloudOf(const PinholeCamera& camera, const std::function<double(int, int)>& depth)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.width = static_cast<std::size_t>(camera.width);
  cloud.height = static_cast<std::size_t>(camera.height);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
    {
      const auto z = static_cast<float>(depth(u, v));
      const Eigen::Vector3f ray = camera.ray(static_cast<float>(u), static_cast<float>(v));
      cloud.points.push_back(z > 0 ? Eigen::Vector3f(ray * z) : Eigen::Vector3f(kNan, kNan, kNan));
    }
  return cloud;
}

/// Depth of a slanted plane through (0, 0, 0.6).
inline double slantedDepth(const PinholeCamera& camera, double u, double v, double slope_x = 1,
                           double slope_y = -0.3)
{
  return 0.6 / (1 - slope_x * (u - camera.cx) / camera.fx - slope_y * (v - camera.cy) / camera.fy);
}

/// Keeps every pixel: at 0.6 m a part of this size has as many pixels as are aimed at.
inline RangeImageOptions everyPixel(const PinholeCamera& camera)
{
  RangeImageOptions options;
  options.diameter_m = 0.1;
  options.largest_diameter_m = 0.1;
  options.pixels_per_diameter = 0.1 * camera.fx / 0.6;
  options.threads = 1;
  return options;
}
}  // namespace ppf_bin_picking

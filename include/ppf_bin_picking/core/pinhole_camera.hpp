/// @file The camera that an organised cloud came from.
#pragma once

#include <Eigen/Core>

namespace ppf_bin_picking
{
/// Pinhole without distortion, optical frame: x right, y down, z forward. Pixel (u, v) has its
/// centre at (u, v).
struct PinholeCamera
{
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  float fx = 0;    ///< [px]
  float fy = 0;    ///< [px]
  float cx = 0;    ///< [px]
  float cy = 0;    ///< [px]

  /// Pixel of a point [m] with z > 0.
  Eigen::Vector2f project(const Eigen::Vector3f& p) const
  {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }

  /// Direction through a pixel, with z = 1.
  Eigen::Vector3f ray(float u, float v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0F}; }

  /// The pixel that a point [m] falls into. False if it is behind the camera or outside the image.
  bool pixelOf(const Eigen::Vector3f& p, int& u, int& v) const
  {
    if (!(p.z() > 0)) return false;
    const Eigen::Vector2f pixel = project(p);
    if (!(pixel.x() > -0.5F && pixel.x() < static_cast<float>(width) - 0.5F)) return false;
    if (!(pixel.y() > -0.5F && pixel.y() < static_cast<float>(height) - 0.5F)) return false;
    u = static_cast<int>(pixel.x() + 0.5F);
    v = static_cast<int>(pixel.y() + 0.5F);
    return true;
  }
};
}  // namespace ppf_bin_picking

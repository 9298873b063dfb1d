/// @file Depth images with their camera.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"

#include <cstddef>
#include <string>

namespace ppf_bin_picking
{
/// What camera.yaml says.
struct DepthCamera
{
  PinholeCamera pinhole;
  float depth_unit_m = 0;  ///< Metres of one grey level.
  std::string frame_id;    ///< tf name of the optical frame.
};

/// Reads `width height fx fy cx cy depth_unit_m frame_id`, all of them needed.
/// @throw InputError for a missing, unknown or mistyped key, or a size or focal length not above 0.
DepthCamera loadDepthCamera(const std::string& path);

/// Reads a 16-bit grey PNG as the organised cloud that the camera would publish: single precision,
/// x = (u - cx) / fx * z in this order; NaN where the level is 0.
/// @throw InputError if the image is damaged, of another kind or size, has more than max_points
///        pixels, or holds no measurement.
PointCloud loadDepthCloud(const std::string& path, const DepthCamera& camera,
                          std::size_t max_points);
}  // namespace ppf_bin_picking

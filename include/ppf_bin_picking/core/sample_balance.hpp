/// @file What samples of a part's surface say of its pose, without rendering.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/pair_kernel.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// False for a surface too flat to the line of sight to be measured well, or turned away.
/// @param point   Camera frame [m].
/// @param normal  Unit, outward, camera frame.
bool facesCamera(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

/// The share of the samples that the image confirms, less the share that it contradicts, a look
/// through the part twice. What lies behind a measured surface says nothing.
/// @param samples           In the frame that the pose takes to the camera's [m]. Those that do
///                          not face the camera, see facesCamera(), do not count.
/// @param T_camera_samples  [m].
/// @param gate_m            How far a measured surface may be from the part's.
/// @return In [-2, 1]; 0 where no sample counts.
float sampleBalance(const RangeImage& image, const PointArrays& samples,
                    const Eigen::Isometry3f& T_camera_samples, float gate_m,
                    const DetectorConfig& config);
}  // namespace ppf_bin_picking

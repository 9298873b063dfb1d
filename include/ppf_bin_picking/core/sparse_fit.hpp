/// @file A quick fit of a part's samples to the range image: sorts out poses before the dear one.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// A pose that was fitted quickly, and what the samples say of it.
struct SparseFit
{
  Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();  ///< Mesh frame [m].
  /// Share of the samples facing the camera that the image confirms, less the share that it
  /// contradicts. In [-2, 1]; self-occlusion is not looked at, so that it is low for hollow parts.
  float balance = 0;
};

/// Fits some of the model's samples that face the camera by a few steps of projective
/// point-to-plane ICP, without rendering and without the outline, and judges the result.
/// @param T_camera_model  Start, mesh frame to camera frame [m].
SparseFit fitSparsely(const RangeImage& image, const PpfModel& model,
                      const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

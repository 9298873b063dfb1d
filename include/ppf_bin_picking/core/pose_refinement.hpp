/// @file Point-to-plane ICP of a part against the range image.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// Moves a pose so that the surface the camera should see fits the measured one: projective
/// point-to-plane ICP (Chen and Medioni 1992) with a gate that narrows and Tukey weights.
/// Directions that the data does not hold are not stepped along.
/// @param T_camera_model  Start, mesh frame to camera frame [m].
/// @return The refined pose; the start if nothing of the part is seen.
Eigen::Isometry3f refinePose(const RangeImage& image, const PpfModel& model,
                             const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

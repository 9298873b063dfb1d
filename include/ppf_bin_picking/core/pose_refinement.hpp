/// @file Point-to-plane ICP of a part against the range image.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// A pose on its way through the refinement.
struct Refinement
{
  Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();  ///< Mesh frame [m].
  int steps = 0;                                                     ///< Taken so far.
  float first_gate_m = 0;  ///< How far from the surface its measurements may lie in the first step.
  /// What the first look's surface says of the pose where its steps ended, see sampleBalance(); 1
  /// before it, and with no icp_iterations.
  float balance = 1;
  bool done = false;  ///< No look is left, or too little is seen of the part.
};

/// Looks at the part from where it is, once, and takes the next steps of refinePose().
void refineByOneLook(const RangeImage& image, const PpfModel& model, const DetectorConfig& config,
                     Refinement& refinement);

/// Moves a pose so that the surface the camera should see fits the measured one: projective
/// point-to-plane ICP (Chen and Medioni 1992) with a gate that narrows and Tukey weights.
/// Directions that the data does not hold are not stepped along.
/// @param T_camera_model  Start, mesh frame to camera frame [m].
/// @return The refined pose; the start if nothing of the part is seen.
Eigen::Isometry3f refinePose(const RangeImage& image, const PpfModel& model,
                             const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config);

/// Lets a refined and verified pose come to rest, in half steps and with the last gates, so that it
/// depends less on where the refinement began.
/// @return The pose given where it would move by more than verification could overlook (0.01 of the
///         diameter at the part's farthest point, about), or with no icp_iterations.
Eigen::Isometry3f settlePose(const RangeImage& image, const PpfModel& model,
                             const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

/// @file The place near a pose that the cloud says most for.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// Where a climb ended.
struct Climb
{
  Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();  ///< Mesh frame [m].
  PoseEvidence evidence;                                             ///< There.
};

/// Moves a refined pose, in steps that get smaller, to where evidenceBalance() is larger (pattern
/// search, Hooke and Jeeves 1961). The refinement follows the measured surface, which shiny parts
/// give tilted; the balance looks at what is seen of the floor within the part and beyond its edges
/// as well; a step is taken where poseScore() rises, too. Only for poses that the cloud says little
/// for, as it finds the place in whole steps and draws the part up to 72 times.
/// @param T_camera_model  Start, mesh frame to camera frame [m].
/// @param evidence        At the start.
/// @return Where it ended; the start with its evidence unless the balance rose by a tenth of the
///         confirmed weight at least. What confirms the pose falls by a tenth at most.
Climb climbEvidence(const RangeImage& image, const PpfModel& model,
                    const Eigen::Isometry3f& T_camera_model, const PoseEvidence& evidence,
                    const DetectorConfig& config);
}  // namespace ppf_bin_picking

/// @file One result out of the detections of parts whose settings differ.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <vector>

namespace ppf_bin_picking_ros
{
/// Puts together what was found on the same cloud by several detections. Of reliable poses of
/// different detections that share more than 0.2 of their surface (see sharedSurface()) only the
/// one with the better score stays reliable; the others become unreliable, each with a region of
/// reason kOverlap. Status and message count anew.
/// @param results  At least one, none of them kBadCloud. A single one is returned as it is.
/// @param models   What the model indices of all results stand for.
ppf_bin_picking::DetectionResult merged(
    std::vector<ppf_bin_picking::DetectionResult> results,
    const std::vector<const ppf_bin_picking::PpfModel*>& models);

/// How much of what the camera sees of one of two parts is surface of both: the share of the
/// pixels in which both would show a surface in the same depth (to 0.03 of the smaller diameter)
/// among the pixels of the part that fills fewer. Parts that touch share nothing; two good poses
/// that explain the same measured points share all.
/// @param T_camera_a, T_camera_b  Mesh frame to the camera's optical frame [m].
/// @return [0, 1].
double sharedSurface(const ppf_bin_picking::PpfModel& a, const Eigen::Isometry3d& T_camera_a,
                     const ppf_bin_picking::PpfModel& b, const Eigen::Isometry3d& T_camera_b);
}  // namespace ppf_bin_picking_ros

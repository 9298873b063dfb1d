/// @file What rviz draws of a detection.
#pragma once

#include "ppf_bin_picking/ros/detection_view.hpp"

#include <visualization_msgs/MarkerArray.h>

namespace ppf_bin_picking_ros
{
/// A detection in the target frame. The first marker deletes those of the detection before.
/// Namespaces: `pickable` (mesh, green), `mismatching_regions` (box, red), `mismatching_poses`
/// (mesh, red), `clusters` (boxes), `noise` (crosses), `roi` (box).
visualization_msgs::MarkerArray toMarkers(const DetectionView& view);

/// Deletes everything drawn before, where a request failed and old poses must not be taken for new.
visualization_msgs::MarkerArray noMarkers(const std_msgs::Header& header);
}  // namespace ppf_bin_picking_ros

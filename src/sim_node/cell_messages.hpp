/// @file What the simulated cell publishes and records.
#pragma once

#include "cell_params.hpp"

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <vector>

namespace ppf_bin_picking_ros
{
/// Organised, in the camera's frame: x y z [m], NaN where nothing was measured, and intensity in
/// [0, 1].
sensor_msgs::PointCloud2 cloudMessage(const ppf_bin_picking::DepthView& view,
                                      const ppf_bin_picking::CellParams& params, ros::Time stamp);

/// T_base_model of each part, in the base frame.
geometry_msgs::PoseArray truthMessage(const std::vector<Eigen::Isometry3d>& T_base_parts,
                                      const ppf_bin_picking::CellParams& params, ros::Time stamp);

/// Base frame to camera frame, base frame to bin frame.
std::vector<geometry_msgs::TransformStamped> frameMessages(
    const ppf_bin_picking::SimulatedCell& cell, const ppf_bin_picking::CellParams& params,
    ros::Time stamp);
}  // namespace ppf_bin_picking_ros

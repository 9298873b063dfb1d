/// @file ROS messages to and from the types of the core.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"

#include <Eigen/Geometry>

#include <geometry_msgs/PoseWithCovariance.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

namespace ppf_bin_picking_ros
{
/// Checks everything the conversion relies on: frame, byte order, fields and their types, steps,
/// length of the data. The number of points and the points themselves are the detector's matter.
/// @return Empty if the cloud can be converted, otherwise one sentence that names the field and the
/// remedy.
std::string messageProblem(const sensor_msgs::PointCloud2& cloud,
                           const ppf_bin_picking::DetectorConfig& config);

/// Copies the points, and the normals if config.use_cloud_normals is set and the cloud has them.
/// Fields may stand in any order and with any padding. Non-finite points stay as they are.
/// @return Points in the message's frame [m].
/// @throw std::invalid_argument with the sentence of messageProblem.
ppf_bin_picking::PointCloud toPointCloud(const sensor_msgs::PointCloud2& cloud,
                                         const ppf_bin_picking::DetectorConfig& config);

/// A pose of one frame in another, with its covariance.
/// @param T_frame_cloud  [m]
/// @param T_cloud_model  [m]
/// @param covariance     Of x y z rx ry rz along the cloud's axes [m, rad]; one that is unknown (-1
///                       in its first entry) stays as it is.
geometry_msgs::PoseWithCovariance toPoseWithCovariance(const Eigen::Isometry3d& T_frame_cloud,
                                                       const Eigen::Isometry3d& T_cloud_model,
                                                       const ppf_bin_picking::Matrix6d& covariance);
}  // namespace ppf_bin_picking_ros

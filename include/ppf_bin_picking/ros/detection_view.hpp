/// @file A detection as it is answered, published and drawn: seen from the target frame.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/ros/messages.hpp"

#include <Eigen/Geometry>

#include <geometry_msgs/PoseArray.h>
#include <std_msgs/Header.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking_ros
{
/// What answers and markers need of a part.
struct PartView
{
  std::string id;
  std::vector<Eigen::Isometry3d> T_model_picks;  ///< Best first [m].
  ppf_bin_picking::TriangleMesh mesh_to_draw;    ///< Mesh frame [m], few triangles.
};

/// One detection and what it takes to express it in the target frame.
struct DetectionView
{
  ppf_bin_picking::DetectionResult result;             ///< In the cloud's frame.
  std::vector<std::shared_ptr<const PartView>> parts;  ///< In the order of the model indices.
  std_msgs::Header header;                             ///< Target frame, stamp of the cloud.
  Eigen::Isometry3d T_target_cloud = Eigen::Isometry3d::Identity();  ///< [m]
  std::optional<ppf_bin_picking::RegionOfInterest> roi;              ///< In the cloud's frame.
};

/// The reliable poses, the most reliable first, in the target frame.
/// @param max_poses  0: all.
std::vector<msg::PickablePose> pickablePoses(const DetectionView& view, std::size_t max_poses);

/// All regions, best score first, in the target frame.
std::vector<msg::MismatchRegion> mismatchRegions(const DetectionView& view);

/// The same poses as pickablePoses, for rviz.
geometry_msgs::PoseArray toPoseArray(const DetectionView& view);
}  // namespace ppf_bin_picking_ros

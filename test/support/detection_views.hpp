/// @file A small detection to draw and to answer with.
#pragma once

#include "ppf_bin_picking/ros/detection_view.hpp"

#include <memory>

namespace ppf_bin_picking_ros
{
/// A turn and a shift that no axis survives.
inline Eigen::Isometry3d exampleTransform()
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(0.1, -0.2, 0.3))
      .rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  return T;
}

inline Eigen::Isometry3d shift(const double x, const double y, const double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A part with one triangle and one pick.
inline std::shared_ptr<PartView> examplePart(const std::string& id)
{
  auto part = std::make_shared<PartView>();
  part->id = id;
  part->T_model_picks = {shift(0, 0, 0.02)};
  part->mesh_to_draw.vertices = {{0, 0, 0}, {0.01F, 0, 0}, {0, 0.01F, 0}};
  part->mesh_to_draw.triangles = {{0, 1, 2}};
  return part;
}

/// Parts `pin` and `nut`; reliable poses of nut (0.9) and pin (0.8), an unreliable one of pin with
/// its region; two hypotheses in a cluster and one of noise.
inline DetectionView exampleView()
{
  DetectionView view;
  view.parts = {examplePart("pin"), examplePart("nut")};
  view.header.frame_id = "base_link";
  view.header.stamp = ros::Time(5, 6);
  view.T_target_cloud = exampleTransform();
  view.roi.emplace();
  view.roi->max = Eigen::Vector3d(1, 2, 3);
  auto& result = view.result;
  result.poses.resize(3);
  result.poses[0].model = 1;
  result.poses[0].score = 0.9;
  result.poses[0].reliability = 0.95;
  result.poses[0].T_cloud_model = shift(0, 0, 0.5);
  result.poses[1].score = 0.8;
  result.poses[0].reliable = result.poses[1].reliable = true;
  result.poses[2].reason = ppf_bin_picking::UnreliableReason::kSpread;
  result.regions.resize(1);
  result.regions[0].reason = ppf_bin_picking::UnreliableReason::kSlippage;
  result.regions[0].box = {shift(0, 0.1, 0.5), Eigen::Vector3d(0.2, 0.1, 0)};
  result.regions[0].T_cloud_best = shift(0, 0.1, 0.6);
  result.regions[0].score = 0.7;
  result.regions[0].reliability = 0.3;
  result.regions[0].hypotheses = 12;
  result.regions[0].detail = "slides";
  result.clusters.resize(1);
  result.clusters[0].box = {shift(0, 0.1, 0.5), Eigen::Vector3d(0.2, 0.1, 0.05)};
  result.distribution.resize(3);
  result.distribution[0].center = {0.1F, 0.2F, 0.3F};
  result.distribution[0].cluster = result.distribution[1].cluster = 0;
  result.distribution[1].rotation = Eigen::AngleAxisf(2.0F, Eigen::Vector3f::UnitX());
  result.distribution[2].center = {0.4F, 0.5F, 0.6F};
  result.scene_points = {{1, 2, 3}, {4, 5, 6}};
  return view;
}
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/detection_view.hpp"

#include "ppf_bin_picking/ros/conversions.hpp"

#include <tf2_eigen/tf2_eigen.h>

namespace ppf_bin_picking_ros
{
namespace
{
msg::PickablePose toMessage(const DetectionView& view, const ppf_bin_picking::DetectedPose& pose,
                            const std::size_t rank)
{
  const PartView& part = *view.parts.at(pose.model);
  const Eigen::Isometry3d T_target_model = view.T_target_cloud * pose.T_cloud_model;
  msg::PickablePose message;
  message.id = part.id + "/" + std::to_string(rank);
  message.model_id = part.id;
  message.pose = toPoseWithCovariance(view.T_target_cloud, pose.T_cloud_model, pose.covariance);
  for (const Eigen::Isometry3d& T_model_pick : part.T_model_picks)
    message.picks.push_back(tf2::toMsg(T_target_model * T_model_pick));
  message.reliability = static_cast<float>(pose.reliability);
  message.score = static_cast<float>(pose.score);
  message.votes = static_cast<float>(pose.votes);
  message.visible_fraction = static_cast<float>(pose.visible_fraction);
  message.rms_error = static_cast<float>(pose.rms_error_m);
  return message;
}

msg::MismatchRegion toMessage(const DetectionView& view,
                              const ppf_bin_picking::MismatchingRegion& region,
                              const std::size_t number)
{
  const PartView& part = *view.parts.at(region.model);
  msg::MismatchRegion message;
  message.id = part.id + "/region-" + std::to_string(number);
  message.model_id = part.id;
  message.reason = static_cast<std::uint8_t>(region.reason);
  message.pose = tf2::toMsg(view.T_target_cloud * region.box.T_cloud_box);
  tf2::toMsg(region.box.size, message.size);
  message.best_pose = tf2::toMsg(view.T_target_cloud * region.T_cloud_best);
  message.reliability = static_cast<float>(region.reliability);
  message.score = static_cast<float>(region.score);
  message.hypotheses = static_cast<std::uint32_t>(region.hypotheses);
  message.detail = region.detail;
  return message;
}
}  // namespace

std::vector<msg::PickablePose> pickablePoses(const DetectionView& view, const std::size_t max_poses)
{
  std::vector<msg::PickablePose> messages;
  for (const ppf_bin_picking::DetectedPose& pose : view.result.poses)
  {
    if (max_poses > 0 && messages.size() == max_poses) break;
    if (pose.reliable) messages.push_back(toMessage(view, pose, messages.size() + 1));
  }
  return messages;
}

std::vector<msg::MismatchRegion> mismatchRegions(const DetectionView& view)
{
  std::vector<msg::MismatchRegion> messages;
  for (const ppf_bin_picking::MismatchingRegion& region : view.result.regions)
    messages.push_back(toMessage(view, region, messages.size() + 1));
  return messages;
}

geometry_msgs::PoseArray toPoseArray(const DetectionView& view)
{
  geometry_msgs::PoseArray message;
  message.header = view.header;
  for (const ppf_bin_picking::DetectedPose& pose : view.result.poses)
    if (pose.reliable)
      message.poses.push_back(tf2::toMsg(view.T_target_cloud * pose.T_cloud_model));
  return message;
}
}  // namespace ppf_bin_picking_ros

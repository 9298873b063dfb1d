/// @file The topics that show a detection.
#pragma once

#include "ppf_bin_picking/ros/detection_view.hpp"

#include <ros/node_handle.h>
#include <ros/publisher.h>

namespace ppf_bin_picking_ros
{
/// Publishes answers and what led to them. One thread at a time.
class ResultPublisher
{
public:
  explicit ResultPublisher(ros::NodeHandle private_nh);

  /// After a detection: all topics; the clouds only while somebody listens.
  void publish(const DetectionView& view, const Response& response);

  /// After a request that gave no detection: its outcome, and nothing to see, so that nobody takes
  /// old poses for new ones.
  void publishFailure(const Response& response);

private:
  ros::Publisher markers_;
  ros::Publisher poses_;
  ros::Publisher detection_;
  ros::Publisher distribution_;
  ros::Publisher orientation_;
  ros::Publisher scene_;
  std::string drawn_frame_;  ///< Of the markers that rviz shows; empty: none.
};
}  // namespace ppf_bin_picking_ros

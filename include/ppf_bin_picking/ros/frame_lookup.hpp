/// @file Transforms within a time that counts on the steady clock.
#pragma once

#include "ppf_bin_picking/ros/cloud_keeper.hpp"

#include <Eigen/Geometry>

#include <tf2/buffer_core.h>

#include <atomic>
#include <string>

namespace ppf_bin_picking_ros
{
/// What to look up: T_target_source at a stamp; stamp 0 means the latest.
struct FrameQuery
{
  std::string target;
  std::string source;
  ros::Time stamp;
};

/// Waits for a transform. The buffer is polled: a look-up with a timeout of its own counts on the
/// ROS clock and never returns once that stands still.
/// @param deadline  The buffer is asked at least once.
/// @param stop      Set from elsewhere to end the wait early.
/// @return T_target_source [m]. The identity without asking if the frames are the same.
/// @throw RequestFailed (TF_FAILED) naming both frames, the stamp and tf's own reason.
Eigen::Isometry3d waitForTransform(const tf2::BufferCore& buffer, const FrameQuery& query,
                                   SteadyClock::time_point deadline, const std::atomic<bool>& stop);
}  // namespace ppf_bin_picking_ros

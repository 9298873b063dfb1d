/// @file Notices a ROS clock that jumps back.
#pragma once

#include <ros/time.h>

#include <mutex>

namespace ppf_bin_picking_ros
{
/// Compares each reading of the ROS clock with the latest before. Thread safe.
class ClockWatch
{
public:
  /// @param now  Reads the clock; called under a lock, so that readings come in order.
  /// @return True once for each jump back by more than 0.1 s: a bag was started again, or a
  ///         simulation. Less is the correction of a computer's clock.
  template <class Now>
  bool jumpedBack(const Now& now)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time reading = now();
    const bool jumped = reading + ros::Duration(0.1) < latest_;
    if (jumped || reading > latest_) latest_ = reading;
    return jumped;
  }

private:
  std::mutex mutex_;
  ros::Time latest_;
};
}  // namespace ppf_bin_picking_ros

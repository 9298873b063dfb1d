/// @file The newest cloud, and waiting for the next.
#pragma once

#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

namespace ppf_bin_picking_ros
{
using SteadyClock = std::chrono::steady_clock;

/// A time limit that a ROS clock at rest cannot stretch. @param seconds  At most a year.
SteadyClock::time_point steadyDeadline(double seconds);

/// Keeps the cloud received last. One thread puts clouds in, others take them. Thread safe.
class CloudKeeper
{
public:
  /// Takes the place of the cloud before; wakes those who wait.
  void keep(const sensor_msgs::PointCloud2ConstPtr& cloud);

  /// The cloud received last; null if none was since the start or since drop().
  sensor_msgs::PointCloud2ConstPtr newest() const;

  /// Waits for a cloud that is received from now on and whose stamp is later than `after`: a cloud
  /// that is there already was not taken later, whatever the camera's clock says. If drop() comes
  /// in between, the clock has jumped back and any stamp will do.
  /// @return Null at the deadline, and at once after stop().
  sensor_msgs::PointCloud2ConstPtr waitForNext(const ros::Time& after,
                                               SteadyClock::time_point deadline) const;

  /// Forgets the cloud: the clock has jumped back.
  void drop();

  /// Ends all waits, now and in future.
  void stop();

  /// Number of clouds received since the start.
  std::uint64_t received() const;

  /// Seconds since the last cloud was received, on the steady clock; nothing before the first.
  std::optional<double> secondsSinceLast() const;

private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  sensor_msgs::PointCloud2ConstPtr cloud_;
  SteadyClock::time_point received_at_;
  std::uint64_t received_ = 0;
  std::uint64_t drops_ = 0;
  bool stopped_ = false;
};
}  // namespace ppf_bin_picking_ros

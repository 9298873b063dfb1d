#include "ppf_bin_picking/ros/cloud_keeper.hpp"

namespace ppf_bin_picking_ros
{
SteadyClock::time_point steadyDeadline(const double seconds)
{
  return SteadyClock::now() +
         std::chrono::duration_cast<SteadyClock::duration>(std::chrono::duration<double>(seconds));
}

void CloudKeeper::keep(const sensor_msgs::PointCloud2ConstPtr& cloud)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    cloud_ = cloud;
    received_at_ = SteadyClock::now();
    ++received_;
  }
  changed_.notify_all();
}

sensor_msgs::PointCloud2ConstPtr CloudKeeper::newest() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return cloud_;
}

sensor_msgs::PointCloud2ConstPtr CloudKeeper::waitForNext(
    const ros::Time& after, const SteadyClock::time_point deadline) const
{
  std::unique_lock<std::mutex> lock(mutex_);
  const std::uint64_t received_before = received_;
  const std::uint64_t drops_before = drops_;
  const auto isNext = [&]
  {
    return cloud_ && received_ != received_before &&
           (cloud_->header.stamp > after || drops_ != drops_before);
  };
  changed_.wait_until(lock, deadline, [&] { return stopped_ || isNext(); });
  return !stopped_ && isNext() ? cloud_ : nullptr;
}

void CloudKeeper::drop()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  cloud_.reset();
  ++drops_;
}

void CloudKeeper::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
}

std::uint64_t CloudKeeper::received() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return received_;
}

std::optional<double> CloudKeeper::secondsSinceLast() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (received_ == 0) return std::nullopt;
  return std::chrono::duration<double>(SteadyClock::now() - received_at_).count();
}
}  // namespace ppf_bin_picking_ros

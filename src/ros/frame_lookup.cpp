#include "ppf_bin_picking/ros/frame_lookup.hpp"

#include "ppf_bin_picking/ros/messages.hpp"
#include "ppf_bin_picking/ros/request_failed.hpp"

#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <optional>
#include <sstream>
#include <thread>

namespace ppf_bin_picking_ros
{
namespace
{
constexpr std::chrono::milliseconds kPollPeriod(5);

/// @param reason  Set if there is none.
std::optional<Eigen::Isometry3d> lookUp(const tf2::BufferCore& buffer, const FrameQuery& query,
                                        std::string& reason)
{
  try
  {
    return tf2::transformToEigen(buffer.lookupTransform(query.target, query.source, query.stamp));
  }
  catch (const tf2::TransformException& error)
  {
    reason = error.what();
    return std::nullopt;
  }
}

std::string failure(const FrameQuery& query, const std::string& reason)
{
  std::ostringstream text;
  text << "No transform from frame '" << query.source << "' to frame '" << query.target << "' at "
       << query.stamp << " (" << reason
       << "): check the frame names, and that tf covers the cloud's stamp within tf_timeout_s";
  return text.str();
}
}  // namespace

Eigen::Isometry3d waitForTransform(const tf2::BufferCore& buffer, const FrameQuery& query,
                                   const SteadyClock::time_point deadline,
                                   const std::atomic<bool>& stop)
{
  if (query.target == query.source) return Eigen::Isometry3d::Identity();
  std::string reason;
  while (true)
  {
    if (const auto T_target_source = lookUp(buffer, query, reason)) return *T_target_source;
    if (stop || SteadyClock::now() >= deadline) break;
    std::this_thread::sleep_for(kPollPeriod);
  }
  throw RequestFailed(Response::TF_FAILED, failure(query, reason));
}
}  // namespace ppf_bin_picking_ros

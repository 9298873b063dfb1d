#include "ppf_bin_picking/ros/request_steps.hpp"

#include "ppf_bin_picking/core/detector.hpp"

#include "ppf_bin_picking/ros/conversions.hpp"
#include "ppf_bin_picking/ros/request_failed.hpp"
#include "ppf_bin_picking/ros/result_merging.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectionResult;
using ppf_bin_picking::DetectionStatus;
using ppf_bin_picking::Detector;

using Indices = std::vector<std::uint32_t>;
using Roi = std::optional<ppf_bin_picking::RegionOfInterest>;

/// Parts with the same settings.
std::vector<Indices> groupsOfEqualSettings(const std::vector<LoadedPartPtr>& parts)
{
  std::map<std::string, std::size_t> group_of_settings;
  std::vector<Indices> groups;
  for (std::uint32_t i = 0; i < parts.size(); ++i)
  {
    const std::string settings = ppf_bin_picking::toYaml(parts[i]->config);
    const auto [group, is_new] = group_of_settings.insert({settings, groups.size()});
    if (is_new) groups.emplace_back();
    groups[group->second].push_back(i);
  }
  return groups;
}

DetectionResult detectGroup(const ppf_bin_picking::PointCloud& cloud,
                            const std::vector<LoadedPartPtr>& parts, const Indices& group,
                            const Roi& roi, const double spent_s, const std::atomic<bool>& stop)
{
  std::vector<const ppf_bin_picking::PpfModel*> models;
  for (const std::uint32_t index : group)
    models.push_back(&parts[index]->model);
  ppf_bin_picking::DetectorConfig config = parts[group.front()]->config;
  config.time_limit_s = remainingLimit_s(config.time_limit_s, spent_s);
  DetectionResult result = Detector(config).detect(cloud, models, roi, &stop);
  for (auto& pose : result.poses)
    pose.model = group[pose.model];
  for (auto& region : result.regions)
    region.model = group[region.model];
  for (auto& cluster : result.clusters)
    cluster.model = group[cluster.model];
  for (auto& hypothesis : result.distribution)
    hypothesis.model = group[hypothesis.model];
  return result;
}

}  // namespace

void checkRequest(const Request& request)
{
  constexpr double kLeastTimeout_s = 0.001;  // as of ~timeout_s
  const auto refuse = [](const std::string& sentence)
  { throw RequestFailed(Response::BAD_REQUEST, sentence); };
  if (request.acquisition != Request::LATEST && request.acquisition != Request::NEXT)
    refuse("acquisition is " + std::to_string(request.acquisition) +
           ": give LATEST (0) or NEXT (1)");
  if (request.timeout < ros::Duration(0))
    refuse("timeout is negative: give seconds, or 0 for ~timeout_s");
  if (!request.timeout.isZero() && request.timeout < ros::Duration(kLeastTimeout_s))
    refuse(
        "timeout is less than a millisecond: give seconds (rosservice call: {secs: 1}), or 0 for "
        "~timeout_s");
  if (request.max_age < ros::Duration(0))
    refuse("max_age is negative: give seconds, or 0 for any age");
}

void checkAge(const Request& request, const ros::Time& stamp, const ros::Time& now)
{
  if (request.max_age.isZero()) return;
  if (stamp.isZero())
    throw RequestFailed(Response::CLOUD_TOO_OLD,
                        "The newest cloud has no stamp, so its age is unknown: let the camera's "
                        "driver stamp its clouds, or ask without max_age");
  checkNotAhead(stamp, now);
  const double age_s = now.toSec() - stamp.toSec();
  if (age_s <= request.max_age.toSec()) return;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "The newest cloud is " << age_s
       << " s old, max_age is " << request.max_age.toSec()
       << " s: check the camera, or ask for the NEXT cloud";
  throw RequestFailed(Response::CLOUD_TOO_OLD, text.str());
}

void checkNotAhead(const ros::Time& stamp, const ros::Time& now)
{
  constexpr double kTolerance_s = 0.1;  // clocks of two machines, and steps of a bag's clock
  const double ahead_s = stamp.toSec() - now.toSec();
  if (ahead_s <= kTolerance_s) return;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "The cloud is stamped " << ahead_s
       << " s in the future, so its age is unknown: set the clock of the camera's driver by this "
          "computer's, or ask for the LATEST cloud without max_age";
  throw RequestFailed(Response::CLOUD_TOO_OLD, text.str());
}

ppf_bin_picking::PointCloud readCloud(const sensor_msgs::PointCloud2& cloud,
                                      const std::vector<LoadedPartPtr>& parts)
{
  ppf_bin_picking::DetectorConfig config = parts.front()->config;
  for (const LoadedPartPtr& part : parts)
    config.use_cloud_normals |= part->config.use_cloud_normals;
  const std::string problem = messageProblem(cloud, config);
  if (!problem.empty()) throw RequestFailed(Response::BAD_CLOUD, problem);
  return toPointCloud(cloud, config);
}

DetectionResult detectParts(const ppf_bin_picking::PointCloud& cloud_camera,
                            const std::vector<LoadedPartPtr>& parts, const Roi& roi,
                            const std::atomic<bool>& stop)
{
  std::vector<const ppf_bin_picking::PpfModel*> models;
  for (const LoadedPartPtr& part : parts)
    models.push_back(&part->model);
  std::vector<DetectionResult> results;
  double spent_s = 0;
  for (const Indices& group : groupsOfEqualSettings(parts))
  {
    results.push_back(detectGroup(cloud_camera, parts, group, roi, spent_s, stop));
    spent_s += results.back().seconds;
    if (results.back().status == DetectionStatus::kBadCloud)
      throw RequestFailed(Response::BAD_CLOUD, results.back().message);
  }
  return merged(std::move(results), models);
}

double remainingLimit_s(const double limit_s, const double spent_s)
{
  constexpr double kLeast_s = 1e-9;  // 0 would be no limit
  return limit_s > 0 ? std::max(limit_s - spent_s, kLeast_s) : 0;
}

std::int16_t toStatus(const DetectionStatus status)
{
  switch (status)
  {
    case DetectionStatus::kOk:
      return Response::OK;
    case DetectionStatus::kNoPickablePose:
      return Response::NO_PICKABLE_POSE;
    case DetectionStatus::kRoiEmpty:
      return Response::ROI_EMPTY;
    case DetectionStatus::kTimeLimit:
      return Response::TIME_LIMIT;
    case DetectionStatus::kBadCloud:
      return Response::BAD_CLOUD;
  }
  return Response::INTERNAL_ERROR;
}

ros::Duration limitedDifference(const ros::Time& later, const ros::Time& earlier)
{
  constexpr double kLimit_s = 2e9;
  return ros::Duration(std::clamp(later.toSec() - earlier.toSec(), -kLimit_s, kLimit_s));
}
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/core/detection_message.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr double kAnotherUnit = 3;  // times as far away: no empty bin is so high
}  // namespace

std::string emptyRegionMessage(const PointCloud& cloud_camera, const RegionOfInterest& roi)
{
  constexpr float kFar = std::numeric_limits<float>::max();
  float nearest = kFar, farthest = 0;
  for (const Eigen::Vector3f& point : cloud_camera.points)
  {
    if (!measured(point)) continue;
    nearest = std::min(nearest, point.z());
    farthest = std::max(farthest, point.z());
  }
  double region_nearest = kFar, region_farthest = -kFar;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d p = roi.min;
    for (int axis = 0; axis < 3; ++axis)
      if ((corner >> axis) % 2 != 0) p[axis] = roi.max[axis];
    const double z = (roi.T_cloud_box * p).z();
    region_nearest = std::min(region_nearest, z);
    region_farthest = std::max(region_farthest, z);
  }
  std::ostringstream text;
  text.precision(3);
  text << "no measured point in the region of interest: the bin is empty, or the region is "
       << "misplaced (the cloud lies " << nearest << " to " << farthest
       << " m before the camera, the region " << region_nearest << " to " << region_farthest
       << " m)";
  if (nearest > kAnotherUnit * region_farthest || kAnotherUnit * farthest < region_nearest)
    text << ": check its frame and the cloud's unit";
  return text.str();
}

std::string noReliablePoseMessage(const DetectionResult& result)
{
  std::map<UnreliableReason, int> counts;
  for (const DetectedPose& pose : result.poses)
    ++counts[pose.reason];
  std::vector<std::pair<int, UnreliableReason>> most;
  for (const auto& [reason, count] : counts)
    most.emplace_back(count, reason);
  std::stable_sort(most.begin(), most.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::ostringstream text;
  text << "no reliable pose among " << result.poses.size() << " found";
  const char* separator = " (";
  for (const auto& [count, reason] : most)
  {
    text << separator << count << " " << toString(reason);
    separator = ", ";
  }
  text << ")";
  if (!result.regions.empty()) text << "; of the best one: " << result.regions.front().detail;
  return text.str();
}
}  // namespace ppf_bin_picking

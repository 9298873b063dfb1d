#include "ppf_bin_picking/core/detection_message.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr double kAnotherUnit = 3;  // times as far away: no empty bin is so high
constexpr std::array<const char*, 3> kDirections = {
    " m along the camera's x axis", " m along the camera's y axis", " m before the camera"};

std::string nothingFoundMessage(const DetectionResult& result)
{
  return "nothing like the part was found among " + std::to_string(result.roi_points) +
         " points: no part is there, or the region of interest, the part's mesh or its unit is "
         "not right";
}

/// @param result  Has poses, none of them reliable.
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
}  // namespace

std::string emptyRegionMessage(const PointCloud& cloud_camera, const RegionOfInterest& roi)
{
  Eigen::AlignedBox3d cloud, region;
  for (const Eigen::Vector3f& point : cloud_camera.points)
    if (measured(point)) cloud.extend(point.cast<double>());
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d p = roi.min;
    for (int axis = 0; axis < 3; ++axis)
      if ((corner >> axis) % 2 != 0) p[axis] = roi.max[axis];
    region.extend(roi.T_cloud_box * p);
  }
  int told = 2;
  for (const int axis : {1, 0, 2})
    if (region.max()[axis] < cloud.min()[axis] || region.min()[axis] > cloud.max()[axis])
      told = axis;
  std::ostringstream text;
  text.precision(3);
  text << "no measured point in the region of interest: the bin is empty, or the region is "
       << "misplaced (the cloud lies " << cloud.min()[told] << " to " << cloud.max()[told]
       << kDirections[static_cast<std::size_t>(told)] << ", the region " << region.min()[told]
       << " to " << region.max()[told] << " m)";
  if (cloud.min().z() > kAnotherUnit * region.max().z() ||
      kAnotherUnit * cloud.max().z() < region.min().z())
    text << ": check its frame and the cloud's unit";
  return text.str();
}

std::size_t reliablePoses(const DetectionResult& result)
{
  return static_cast<std::size_t>(std::count_if(result.poses.begin(), result.poses.end(),
                                                [](const DetectedPose& pose)
                                                { return pose.reliable; }));
}

std::string reliablePosesInWords(std::size_t count)
{
  return std::to_string(count) + (count == 1 ? " reliable pose" : " reliable poses");
}

std::string searchMessage(const DetectionResult& result)
{
  const std::size_t reliable = reliablePoses(result);
  if (reliable > 0) return reliablePosesInWords(reliable);
  return result.poses.empty() ? nothingFoundMessage(result) : noReliablePoseMessage(result);
}
}  // namespace ppf_bin_picking

/// @file The sentences on results that a person has to act on.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include <string>

namespace ppf_bin_picking
{
/// One sentence on a region without measured points. It says how far away the cloud and the region
/// are along the camera's z axis, and asks for unit and frame where these cannot be right.
/// @param cloud_camera  Camera's optical frame [m]; has a measured point.
std::string emptyRegionMessage(const PointCloud& cloud_camera, const RegionOfInterest& roi);

/// One sentence on a result of which no pose is reliable: how many were turned down for which
/// reason, the most frequent first, and what the region with the best score says.
/// @param result  Has poses, sorted regions, and no reliable pose.
std::string noReliablePoseMessage(const DetectionResult& result);
}  // namespace ppf_bin_picking

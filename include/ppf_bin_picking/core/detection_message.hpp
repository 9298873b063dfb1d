/// @file The sentences on results that a person has to act on.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include <cstddef>
#include <string>

namespace ppf_bin_picking
{
/// One sentence on a region without measured points. It says from where to where the cloud and the
/// region reach along the camera's z axis, or along one on which they do not meet, and asks for
/// unit and frame where these cannot be right.
/// @param cloud_camera  Camera's optical frame [m]; has a measured point.
std::string emptyRegionMessage(const PointCloud& cloud_camera, const RegionOfInterest& roi);

/// How many poses of a result are reliable.
std::size_t reliablePoses(const DetectionResult& result);

/// `1 reliable pose`, `2 reliable poses`.
std::string reliablePosesInWords(std::size_t count);

/// One sentence on a search that was not cut short: how many poses are reliable. If none is, how
/// many were turned down for which reason, the most frequent first, and what the region with the
/// best score says; if none was found, what may be the cause.
/// @param result  Its regions are sorted.
std::string searchMessage(const DetectionResult& result);
}  // namespace ppf_bin_picking

/// @file The steps of a request that need no state of the server.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include "ppf_bin_picking/ros/messages.hpp"
#include "ppf_bin_picking/ros/part_store.hpp"

#include <sensor_msgs/PointCloud2.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking_ros
{
/// @throw RequestFailed (BAD_REQUEST) naming the field that is out of range.
void checkRequest(const Request& request);

/// @throw RequestFailed (CLOUD_TOO_OLD) if the request limits the age and the cloud is older, has
///        no stamp or fails checkNotAhead().
void checkAge(const Request& request, const ros::Time& stamp, const ros::Time& now);

/// A camera's clock that is ahead makes any cloud look new.
/// @throw RequestFailed (CLOUD_TOO_OLD) if the stamp lies more than 0.1 s in the future.
void checkNotAhead(const ros::Time& stamp, const ros::Time& now);

/// @return The message as points, with normals if the settings of a part use them.
/// @throw RequestFailed (BAD_CLOUD) with the reason.
ppf_bin_picking::PointCloud readCloud(const sensor_msgs::PointCloud2& cloud,
                                      const std::vector<LoadedPartPtr>& parts);

/// Finds the parts. Those of equal settings compete for the cloud; parts of other settings are
/// looked for on their own, and merged() decides where two of them stand in one place. Time limits
/// count over all detections.
/// @param stop  Set from elsewhere to end the search early, with what it has.
/// @return Poses name the parts by their index; reliable ones first, the most reliable first.
/// @throw RequestFailed (BAD_CLOUD) if the cloud cannot be worked on.
ppf_bin_picking::DetectionResult detectParts(
    const ppf_bin_picking::PointCloud& cloud_camera, const std::vector<LoadedPartPtr>& parts,
    const std::optional<ppf_bin_picking::RegionOfInterest>& roi, const std::atomic<bool>& stop);

/// What is left of a time limit: above 0, as 0 means no limit, which stays.
double remainingLimit_s(double limit_s, double spent_s);

/// The status constant of GetPickablePoses.
std::int16_t toStatus(ppf_bin_picking::DetectionStatus status);

/// A difference of stamps as a duration; what a duration cannot hold becomes its limit.
ros::Duration limitedDifference(const ros::Time& later, const ros::Time& earlier);
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/core/detection_message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
DetectionResult resultWith(const std::vector<UnreliableReason>& reasons)
{
  DetectionResult result;
  for (const UnreliableReason reason : reasons)
  {
    result.poses.emplace_back();
    result.poses.back().reason = reason;
  }
  return result;
}

TEST(SearchMessage, countsTheReasonsAndTellsOfTheBestPoseIfNoneIsReliable)
{
  DetectionResult result = resultWith({UnreliableReason::kRunnerUp, UnreliableReason::kSlippage,
                                       UnreliableReason::kLowScore, UnreliableReason::kSlippage});
  EXPECT_EQ(searchMessage(result),
            "no reliable pose among 4 found (2 SLIPPAGE, 1 LOW_SCORE, 1 RUNNER_UP)");
  result.regions.resize(2);
  result.regions[0].detail = "it slides";
  result.regions[1].detail = "it does not";
  EXPECT_EQ(searchMessage(result),
            "no reliable pose among 4 found (2 SLIPPAGE, 1 LOW_SCORE, 1 RUNNER_UP); of the best "
            "one: it slides");
}

TEST(SearchMessage, tellsAmongHowManyPointsNothingWasFound)
{
  DetectionResult result;
  result.roi_points = 12;
  EXPECT_EQ(searchMessage(result).find("nothing like the part was found among 12 points"), 0U);
}

TEST(ReliablePoses, areCountedAndPutInWords)
{
  DetectionResult result = resultWith({UnreliableReason::kRunnerUp, UnreliableReason::kNone});
  result.poses[1].reliable = true;
  EXPECT_EQ(reliablePoses(result), 1U);
  EXPECT_EQ(reliablePosesInWords(1), "1 reliable pose");
  EXPECT_EQ(reliablePosesInWords(2), "2 reliable poses");
  EXPECT_EQ(searchMessage(result), "1 reliable pose");
}

/// A region between two depths [m], in a frame turned upside down.
RegionOfInterest regionAt(double near_m, double far_m)
{
  RegionOfInterest region;
  region.T_cloud_box.translation().z() = far_m;
  region.T_cloud_box.linear() =
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  region.min = {-0.1, -0.1, 0};
  region.max = {0.1, 0.1, far_m - near_m};
  return region;
}

TEST(EmptyRegionMessage, tellsHowFarAwayCloudAndRegionAreAndAsksForTheUnitIfOneIsFarBeyondTheOther)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.points = {{0, 0, 0.5F}, {kNan, kNan, kNan}, {0, 0, 0}, {1, 0, 0.75F}};
  EXPECT_EQ(emptyRegionMessage(cloud, regionAt(0.25, 0.625)),
            "no measured point in the region of interest: the bin is empty, or the region is "
            "misplaced (the cloud lies 0.5 to 0.75 m before the camera, the region 0.25 to 0.625 "
            "m)");
  RegionOfInterest beside = regionAt(0.25, 0.625);
  beside.min.x() += 2;
  beside.max.x() += 2;
  EXPECT_NE(
      emptyRegionMessage(cloud, beside)
          .find("(the cloud lies 0 to 1 m along the camera's x axis, the region 1.9 to 2.1 m)"),
      std::string::npos)
      << emptyRegionMessage(cloud, beside);
  for (const double factor : {0.001, 1000.0})
  {
    const std::string message = emptyRegionMessage(cloud, regionAt(0.25 * factor, 0.625 * factor));
    EXPECT_NE(message.find("check its frame and the cloud's unit"), std::string::npos) << message;
  }
}
}  // namespace
}  // namespace ppf_bin_picking

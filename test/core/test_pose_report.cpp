#include "ppf_bin_picking/core/pose_report.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ppf_bin_picking
{
namespace
{
DetectedPose poseWith(bool reliable, double reliability, double score)
{
  DetectedPose pose;
  pose.reliable = reliable;
  pose.reliability = reliability;
  pose.score = score;
  return pose;
}

TEST(SortResult, putsTheMostReliablePoseFirstAndThenTheBestScore)
{
  DetectionResult result;
  result.poses = {poseWith(false, 0.99, 1.0), poseWith(true, 0.92, 1.0), poseWith(true, 0.97, 0.8),
                  poseWith(false, 0.99, 0.5), poseWith(true, 0.97, 0.9)};
  result.regions.resize(2);
  result.regions[1].score = 0.7;
  sortResult(result);
  std::vector<double> scores;
  for (const DetectedPose& pose : result.poses)
    scores.push_back(pose.score);
  EXPECT_EQ(scores, (std::vector<double>{0.9, 0.8, 1.0, 1.0, 0.5}));
  EXPECT_TRUE(result.poses[2].reliable);
  EXPECT_FALSE(result.poses[3].reliable);
  EXPECT_EQ(result.regions[0].score, 0.7);
}
}  // namespace
}  // namespace ppf_bin_picking

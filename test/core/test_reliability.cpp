#include "ppf_bin_picking/core/reliability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// A pose as right ones are on average.
DetectedPose ordinaryPose()
{
  DetectedPose pose;
  pose.score = 0.9;
  pose.margin = 0.45;
  pose.hold = 0.07;
  pose.spread = 0.2;
  pose.looked_through = 0.015;
  pose.outline_broken = 0.2;
  pose.goes_on = 0.05;
  pose.claimed = 0;
  pose.confirmed_px = 2000;
  pose.visible_fraction = 0.75;
  return pose;
}

double changed(const std::function<void(DetectedPose&)>& change)
{
  DetectedPose pose = ordinaryPose();
  change(pose);
  return assessReliability(pose).probability;
}

UnreliableReason weakest(const std::function<void(DetectedPose&)>& change)
{
  DetectedPose pose = ordinaryPose();
  change(pose);
  return assessReliability(pose).weakest;
}

TEST(Reliability, anOrdinaryRightPoseIsTrustedAndOneWithNothingForItIsNot)
{
  EXPECT_GT(assessReliability(ordinaryPose()).probability, 0.95);
  EXPECT_LT(assessReliability(DetectedPose()).probability, 0.1);
}

TEST(Reliability, fallsWithAllThatSpeaksAgainstAPose)
{
  const double ordinary = assessReliability(ordinaryPose()).probability;
  EXPECT_LT(changed([](DetectedPose& pose) { pose.score = 0.5; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.margin = 0.1; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.hold = 0.005; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.slide_share = 0.9; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.spread = 1.4; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.looked_through = 0.2; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.goes_on = 0.4; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.claimed = 0.2; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.confirmed_px = 100; }), ordinary);
  EXPECT_LT(changed([](DetectedPose& pose) { pose.visible_fraction = 0.2; }), ordinary);
}

TEST(Reliability, staysFiniteForExtremeValues)
{
  const auto extreme = [](DetectedPose& pose)
  {
    pose.score = pose.hold = 0;
    pose.margin = -50;
    pose.spread = 1000;
    pose.confirmed_px = 0;
  };
  EXPECT_GE(changed(extreme), 0.0);
  EXPECT_LT(changed(extreme), 0.01);
  EXPECT_LE(changed([](DetectedPose& pose) { pose.score = pose.margin = pose.hold = 1; }), 1.0);
}

TEST(Reliability, namesWhatPulledItDown)
{
  EXPECT_EQ(weakest([](DetectedPose& pose) { pose.margin = 0; }), UnreliableReason::kRunnerUp);
  EXPECT_EQ(weakest([](DetectedPose& pose) { pose.hold = 0.002; }), UnreliableReason::kSlippage);
  EXPECT_EQ(weakest([](DetectedPose& pose) { pose.spread = 1.5; }), UnreliableReason::kSpread);
  EXPECT_EQ(weakest([](DetectedPose& pose) { pose.claimed = 0.3; }), UnreliableReason::kOverlap);
  EXPECT_EQ(weakest([](DetectedPose& pose) { pose.looked_through = 0.3; }),
            UnreliableReason::kLowScore);
}

/// Ordinary poses, each looked through by so much, and pierced by half of it.
std::vector<DetectedPose> posesWith(const std::vector<double>& shares)
{
  std::vector<DetectedPose> poses;
  for (const double share : shares)
  {
    poses.push_back(ordinaryPose());
    poses.back().looked_through = share;
    poses.back().pierced = share / 2;
  }
  return poses;
}

TEST(UsualShares, isTheMedianOfTheOtherProbablePosesAndOfFiveUntouchedOnes)
{
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> share(0, 0.12), margin(-0.2, 0.5);
  for (int round = 0; round < 30; ++round)
  {
    std::vector<double> shares(static_cast<std::size_t>(round));
    std::generate(shares.begin(), shares.end(), [&] { return share(rng); });
    std::vector<DetectedPose> poses = posesWith(shares);
    for (DetectedPose& pose : poses)
      pose.margin = margin(rng);
    setUsualShares(poses);
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      std::vector<double> known(5, 0.0);
      for (std::size_t j = 0; j < poses.size(); ++j)
      {
        DetectedPose other = poses[j];
        other.usual_looked_through = 0;
        if (j != i && assessReliability(other).probability >= 0.7)
          known.push_back(other.looked_through);
      }
      std::sort(known.begin(), known.end());
      EXPECT_EQ(poses[i].usual_looked_through, known[(known.size() - 1) / 2]);
      EXPECT_EQ(poses[i].usual_pierced, known[(known.size() - 1) / 2] / 2);
    }
  }
}

TEST(UsualShares, ofFewPosesIsNothing)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(6, 0.05));
  setUsualShares(poses);
  for (const DetectedPose& pose : poses)
    EXPECT_EQ(pose.usual_looked_through, 0);
}

TEST(UsualShares, isNotLearnedFromDoubtfulPosesNorFromThoseOfAnotherPart)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(30, 0.05));
  for (std::size_t i = 0; i < 15; ++i)
    poses[i].margin = -0.2;
  for (std::size_t i = 15; i < 30; ++i)
    poses[i].model = 1;
  setUsualShares(poses);
  EXPECT_EQ(poses.front().usual_looked_through, 0);
  EXPECT_EQ(poses.back().usual_looked_through, 0.05);
}

TEST(UsualShares, isNotHeldAgainstAPoseAndMoreIs)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(20, 0.06));
  poses.push_back(posesWith({0.2}).front());
  const double alone = assessReliability(poses.front()).probability;
  setUsualShares(poses);
  DetectedPose spotless = ordinaryPose();
  spotless.looked_through = 0;
  EXPECT_EQ(assessReliability(poses.front()).probability, assessReliability(spotless).probability);
  EXPECT_GT(assessReliability(poses.front()).probability, alone);
  EXPECT_LT(assessReliability(poses.back()).probability, 0.8);
}

TEST(UsualShares, excuseNoMoreThanThreeTwentieths)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(20, 0.2));
  for (DetectedPose& pose : poses)
  {
    pose.margin = pose.hold = 0.6;  // trusted all the same
    pose.pierced = 0.5;
  }
  setUsualShares(poses);
  EXPECT_EQ(poses.front().usual_looked_through, 0.15);
  EXPECT_EQ(poses.front().usual_pierced, 0.15);
}

TEST(UsualShares, whatWasWrittenBeforeIsNotBuiltOn)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(12, 0.1));
  setUsualShares(poses);
  const std::vector<DetectedPose> once = poses;
  setUsualShares(poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_EQ(poses[i].usual_looked_through, once[i].usual_looked_through);
}
}  // namespace
}  // namespace ppf_bin_picking

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

/// Within a region of interest, and in the whole cloud.
class ReliabilityTest : public ::testing::TestWithParam<bool>
{
protected:
  static double probability(const DetectedPose& pose)
  {
    return assessReliability(pose, GetParam()).probability;
  }

  static double changed(const std::function<void(DetectedPose&)>& change)
  {
    DetectedPose pose = ordinaryPose();
    change(pose);
    return probability(pose);
  }

  static ReliabilityTerm main_doubt(const std::function<void(DetectedPose&)>& change)
  {
    DetectedPose pose = ordinaryPose();
    change(pose);
    return assessReliability(pose, GetParam()).main_doubt;
  }
};

INSTANTIATE_TEST_SUITE_P(Searches, ReliabilityTest, ::testing::Bool(),
                         [](const auto& searched)
                         { return searched.param ? "wholeCloud" : "region"; });

TEST_P(ReliabilityTest, anOrdinaryRightPoseIsTrustedAndOneWithNothingForItIsNot)
{
  EXPECT_GT(probability(ordinaryPose()), 0.95);
  EXPECT_LT(probability(DetectedPose()), 0.1);
}

TEST(Reliability, isLowerInTheWholeCloudForAPoseThatSlides)
{
  DetectedPose pose = ordinaryPose();
  pose.slide_share = 0.6;
  EXPECT_LT(assessReliability(pose, true).probability, assessReliability(pose, false).probability);
}

TEST_P(ReliabilityTest, fallsWithAllThatSpeaksAgainstAPose)
{
  const double ordinary = probability(ordinaryPose());
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

TEST_P(ReliabilityTest, staysFiniteForExtremeValues)
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

TEST_P(ReliabilityTest, namesWhatPulledItDown)
{
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.margin = 0; }), ReliabilityTerm::kMargin);
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.hold = 0.002; }), ReliabilityTerm::kHold);
  // within a region the fit gives the spread next to no weight: the other terms say what it does
  if (GetParam())
  {
    EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.spread = 1.5; }), ReliabilityTerm::kSpread);
  }
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.claimed = 0.3; }), ReliabilityTerm::kClaimed);
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.looked_through = 0.3; }),
            ReliabilityTerm::kLookedThrough);
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.goes_on = 0.5; }), ReliabilityTerm::kGoesOn);
  EXPECT_EQ(main_doubt([](DetectedPose& pose) { pose.confirmed_px = 30; }),
            ReliabilityTerm::kConfirmed);
}

TEST(ReliabilityTerm, hasTheReasonThatAnOperatorIsShown)
{
  EXPECT_EQ(reasonOf(ReliabilityTerm::kMargin), UnreliableReason::kRunnerUp);
  EXPECT_EQ(reasonOf(ReliabilityTerm::kGoesOn), UnreliableReason::kSlippage);
  EXPECT_EQ(reasonOf(ReliabilityTerm::kSpread), UnreliableReason::kSpread);
  EXPECT_EQ(reasonOf(ReliabilityTerm::kClaimed), UnreliableReason::kOverlap);
  EXPECT_EQ(reasonOf(ReliabilityTerm::kVisible), UnreliableReason::kLowScore);
}

double probabilityInRegion(const DetectedPose& pose)
{
  return assessReliability(pose, false).probability;
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

TEST(UsualShares, areTheMedianOfTheOthersThatShowThemAndOfFiveZeros)
{
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> share(0, 0.12);
  for (int round = 0; round < 30; ++round)
  {
    std::vector<double> shares(static_cast<std::size_t>(round));
    std::generate(shares.begin(), shares.end(), [&] { return share(rng); });
    std::vector<DetectedPose> poses = posesWith(shares);
    std::vector<bool> shows;
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      shows.push_back(rng() % 4 != 0);
      poses[i].model = rng() % 8 == 0 ? 1 : 0;
    }
    setUsualShares(shows, poses);
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      std::vector<double> known(5, 0.0);
      for (std::size_t j = 0; j < poses.size(); ++j)
        if (j != i && shows[j] && poses[j].model == poses[i].model) known.push_back(shares[j]);
      std::sort(known.begin(), known.end());
      const double median = known[(known.size() - 1) / 2];
      EXPECT_EQ(poses[i].usual_looked_through, std::min(median, 0.1));
      EXPECT_EQ(poses[i].usual_pierced, std::min(median / 2, 0.1));
    }
  }
}

TEST(UsualShares, ofFewPosesAreNothing)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(6, 0.05));
  setUsualShares(std::vector<bool>(6, true), poses);
  for (const DetectedPose& pose : poses)
    EXPECT_EQ(pose.usual_looked_through, 0);
}

TEST(UsualShares, areNotHeldAgainstAPoseAndMoreIs)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(20, 0.06));
  poses.push_back(posesWith({0.2}).front());
  const double alone = probabilityInRegion(poses.front());
  setUsualShares(std::vector<bool>(21, true), poses);
  DetectedPose spotless = ordinaryPose();
  spotless.looked_through = 0;
  EXPECT_EQ(probabilityInRegion(poses.front()), probabilityInRegion(spotless));
  EXPECT_GT(probabilityInRegion(poses.front()), alone);
  EXPECT_LT(probabilityInRegion(poses.back()), 0.8);
}

TEST(UsualShares, excuseNoMoreThanATenth)
{
  std::vector<DetectedPose> poses = posesWith(std::vector<double>(20, 0.5));
  setUsualShares(std::vector<bool>(20, true), poses);
  EXPECT_EQ(poses.front().usual_looked_through, 0.1);
  EXPECT_EQ(poses.front().usual_pierced, 0.1);
  EXPECT_LT(probabilityInRegion(poses.front()), 0.1);
}
}  // namespace
}  // namespace ppf_bin_picking

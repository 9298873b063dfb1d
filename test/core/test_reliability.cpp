#include "ppf_bin_picking/core/reliability.hpp"

#include <gtest/gtest.h>

#include <functional>

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
  EXPECT_LT(changed([](DetectedPose& pose) { pose.outline_broken = 0.6; }), ordinary);
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
}  // namespace
}  // namespace ppf_bin_picking

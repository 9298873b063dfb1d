#include "ppf_bin_picking/core/pose_verdict.hpp"

#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
class VerdictTest : public ::testing::Test
{
protected:
  VerdictTest()
  {
    good_.score = good_.visible_fraction = good_.reliability = 1;
    good_.confirmed_px = 2000;
  }

  PoseVerdict verdict(const std::function<void(DetectedPose&)>& change) const
  {
    DetectedPose pose = good_;
    change(pose);
    return verdictOf(pose, true, share_, model_, config_);
  }

  void expectPasses(const std::function<void(DetectedPose&)>& change) const
  {
    const PoseVerdict passed = verdict(change);
    EXPECT_EQ(passed.reason, UnreliableReason::kNone) << passed.detail;
    EXPECT_EQ(passed.detail, "");
  }

  DetectedPose good_;
  ClusterShare share_;
  DetectorConfig config_;
  const PpfModel model_ = coarselyTrained(boxMesh({0.08F, 0.06F, 0.006F}));
};

TEST_F(VerdictTest, trustsAPoseThatPassesEveryGate)
{
  expectPasses([](DetectedPose&) {});
}

TEST_F(VerdictTest, namesTheGateThatAPoseFails)
{
  struct Case
  {
    std::function<void(DetectedPose&)> change;
    UnreliableReason reason;
    std::string word;
  };
  const std::vector<Case> cases = {
      {[](DetectedPose& pose) { pose.slide_share = 0.9; }, UnreliableReason::kSlippage,
       "max_slide_share"},
      {[](DetectedPose& pose) { pose.outline_broken = 0.8; }, UnreliableReason::kLowScore,
       "max_outline_broken"},
      {[](DetectedPose& pose) { pose.pierced = 0.35; }, UnreliableReason::kLowScore, "max_pierced"},
      {[](DetectedPose& pose) { pose.margin = 0; }, UnreliableReason::kRunnerUp, "min_margin"},
      {[](DetectedPose& pose) { pose.margin = -0.1; }, UnreliableReason::kRunnerUp,
       "better, with 10 % more evidence"},
      {[](DetectedPose& pose) { pose.score = 0.1; }, UnreliableReason::kLowScore, "min_score"},
      {[](DetectedPose& pose) { pose.visible_fraction = 0.1; }, UnreliableReason::kLowScore,
       "min_visible_share"},
      {[](DetectedPose& pose) { pose.confirmed_px = 3; }, UnreliableReason::kLowScore,
       "min_confirmed_px"},
      {[](DetectedPose& pose)
       {
         pose.reliability = 0.2;
         pose.claimed = 0.5;
         pose.main_doubt = ReliabilityTerm::kClaimed;
       },
       UnreliableReason::kOverlap, "min_reliability"}};
  for (const Case& one : cases)
  {
    SCOPED_TRACE(one.word);
    const PoseVerdict failed = verdict(one.change);
    EXPECT_EQ(failed.reason, one.reason);
    EXPECT_NE(failed.detail.find(one.word), std::string::npos) << failed.detail;
  }
}

TEST_F(VerdictTest, tellsTheTermThatPulledTheReliabilityDown)
{
  const auto told = [this](ReliabilityTerm term)
  {
    return verdict(
               [&](DetectedPose& pose)
               {
                 pose.reliability = 0.8;
                 pose.main_doubt = term;
                 pose.score = 0.51;
                 pose.margin = 0.26;
                 pose.looked_through = 0.12;
                 pose.goes_on = 0.13;
                 pose.slide_share = 0.54;
                 pose.visible_fraction = 0.25;
                 pose.confirmed_px = 66;
               })
        .detail;
  };
  const std::string before = "right with a probability of 80 % only (min_reliability 90 %): ";
  EXPECT_EQ(told(ReliabilityTerm::kScore),
            before + "the cloud confirms only 51 % of what it should see of it");
  EXPECT_EQ(told(ReliabilityTerm::kMargin),
            before + "another pose explains the same points with 26 % less evidence");
  EXPECT_EQ(told(ReliabilityTerm::kLookedThrough),
            before + "the cloud lies behind 12 % of the surface");
  EXPECT_EQ(told(ReliabilityTerm::kGoesOn),
            before + "the measured surface goes on at 13 % of its edges");
  EXPECT_EQ(told(ReliabilityTerm::kSlideShare),
            before +
                "the measured surface goes on beyond 54 % of the outline that should stop a "
                "slide");
  EXPECT_EQ(told(ReliabilityTerm::kVisible), before + "only 25 % of it is not hidden");
  EXPECT_EQ(told(ReliabilityTerm::kConfirmed), before + "only 66 pixels confirm it");
}

TEST_F(VerdictTest, showsThatAShareMissesItsLimit)
{
  EXPECT_NE(verdict([](DetectedPose& pose) { pose.reliability = 0.897; })
                .detail.find("probability of 89.7 % only (min_reliability 90.0 %)"),
            std::string::npos);
  EXPECT_NE(verdict([](DetectedPose& pose) { pose.margin = 0.047; })
                .detail.find("4.7 % less evidence (min_margin 5.0 %)"),
            std::string::npos);
}

TEST_F(VerdictTest, trustsAFirmlyHeldPoseWhateverItsOutline)
{
  const auto held_by_surfaces = [](DetectedPose& pose)
  {
    pose.slide_share = 0.9;
    pose.hold = 0.1;
  };
  expectPasses(held_by_surfaces);
  config_.firm_hold = 0.2;
  EXPECT_EQ(verdict(held_by_surfaces).reason, UnreliableReason::kSlippage);
}

TEST_F(VerdictTest, toleratesAsManyBrokenEdgesAsItIsTold)
{
  config_.max_outline_broken = 0.9;
  expectPasses([](DetectedPose& pose) { pose.outline_broken = 0.8; });
}

TEST_F(VerdictTest, toleratesWhatPassesThroughAsFarAsItIsTold)
{
  config_.max_pierced = 0.4;
  expectPasses([](DetectedPose& pose) { pose.pierced = 0.35; });
}

TEST_F(VerdictTest, toleratesWhatPassesThroughOtherPosesAsWell)
{
  const auto pierced = [](DetectedPose& pose)
  {
    pose.pierced = 0.35;
    pose.usual_pierced = 0.1;
  };
  expectPasses(pierced);
  config_.max_pierced = 0.2;
  const PoseVerdict failed = verdict(pierced);
  EXPECT_NE(failed.detail.find("35 % of its edges (10 % is usual here"), std::string::npos)
      << failed.detail;
}

TEST_F(VerdictTest, namesNoGateThatIsOff)
{
  config_.mismatch_test = false;
  const auto doubtful = [](DetectedPose& pose)
  {
    pose.slide_share = pose.outline_broken = pose.pierced = 1;
    pose.margin = pose.reliability = 0;
  };
  expectPasses(doubtful);
  const PoseVerdict failed = verdict(
      [&](DetectedPose& pose)
      {
        doubtful(pose);
        pose.score = 0.1;
      });
  EXPECT_EQ(failed.reason, UnreliableReason::kLowScore);
  EXPECT_EQ(failed.detail.find("score 10 % (min_score"), 0U) << failed.detail;
}

TEST_F(VerdictTest, turnsSpreadHypothesesDownUnlessTheClusteringKnowsNone)
{
  share_.box.size = Eigen::Vector3d::Constant(model_.diameter());
  EXPECT_EQ(verdict([](DetectedPose&) {}).reason, UnreliableReason::kSpread);
  config_.clustering = Clustering::kGreedy;
  expectPasses([](DetectedPose&) {});
}

TEST_F(VerdictTest, trustsNoPoseWithUnknownRivals)
{
  const PoseVerdict failed = verdictOf(good_, false, share_, model_, config_);
  EXPECT_EQ(failed.reason, UnreliableReason::kRunnerUp);
  EXPECT_NE(failed.detail.find("time_limit_s"), std::string::npos);
}
}  // namespace
}  // namespace ppf_bin_picking

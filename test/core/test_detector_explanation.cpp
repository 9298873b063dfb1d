#include "ppf_bin_picking/core/detector.hpp"

#include "support/bracket_and_angle.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
using DetectorExplanation = BracketAndAngle;

TEST_F(DetectorExplanation, explainsAWrongPoseByWhatStoppedIt)
{
  const Detector detector(coarseConfig());
  const PoseExplanation in_the_air =
      detector.explain(cloud(), bracket_, roi_, poseOf(0.3, {1, 1, 0}, {0.02, 0, 0.4}));
  EXPECT_EQ(in_the_air.fate, PoseFate::kNoVotes);
  EXPECT_GT(in_the_air.evidence.looked_through, 10 * in_the_air.evidence.confirmed_weight);
  EXPECT_EQ(in_the_air.rank, -1);
  // End for end its plate fits, and the pose that stands there owns that.
  const PoseExplanation turned = detector.explain(
      cloud(), bracket_, roi_, T_camera_bracket_ * poseOf(M_PI, {0, 0, 1}, {0, 0, 0}));
  EXPECT_NE(turned.fate, PoseFate::kReliable);
  EXPECT_EQ(turned.rank, -1);
  EXPECT_EQ(turned.owner, 0);
  EXPECT_GT(turned.owned_share, 0.5);
  EXPECT_LT(turned.score, 0.7);
  const PoseExplanation beside =
      detector.explain(cloud(), bracket_, roi_, poseOf(0.3, {1, 1, 0}, {20, 0, 400}));
  EXPECT_EQ(beside.fate, PoseFate::kOutOfSight);
  EXPECT_GE(beside.hold, 0);
  RegionOfInterest nowhere = roi_;
  nowhere.T_cloud_box.translation().x() += 1;
  const PoseExplanation outside = detector.explain(cloud(), bracket_, nowhere, T_camera_bracket_);
  EXPECT_EQ(outside.fate, PoseFate::kNotLookedFor);
  EXPECT_EQ(outside.result.status, DetectionStatus::kRoiEmpty);
}

TEST_F(DetectorExplanation, explainsARightPoseThatTheRegionLeavesOut)
{
  RegionOfInterest beside = roi_;
  beside.min.x() = -0.02;
  const PoseExplanation left_out =
      Detector(coarseConfig()).explain(cloud(), bracket_, beside, T_camera_bracket_);
  EXPECT_EQ(left_out.fate, PoseFate::kOutsideRegion);
  EXPECT_GT(left_out.evidence.outside, 0.5 * left_out.evidence.expected());
}

TEST_F(DetectorExplanation, explainsARoughPoseByThePoseThatItsRefinementLandsOn)
{
  const Eigen::Isometry3d rough =
      T_camera_bracket_ * poseOf(0, {0, 0, 1}, {0.12 * bracket_.diameter(), 0, 0});
  const PoseExplanation explained =
      Detector(coarseConfig()).explain(cloud(), bracket_, roi_, rough);
  EXPECT_EQ(explained.rank, -1);
  EXPECT_EQ(explained.refined_rank, 0);
}

TEST_F(DetectorExplanation, explainsAPoseThatTheFirstLooksGiveUp)
{
  DetectorConfig strict = coarseConfig();
  const auto explained = [&]
  { return Detector(strict).explain(cloud(), bracket_, roi_, T_camera_bracket_); };
  strict.min_sparse_balance = 1;
  const PoseExplanation after_fit = explained();
  EXPECT_EQ(after_fit.fate, PoseFate::kGivenUp);
  EXPECT_GT(after_fit.quick_balance, coarseConfig().min_sparse_balance);
  strict.min_sparse_balance = coarseConfig().min_sparse_balance;
  strict.min_look_balance = 1;
  const PoseExplanation after_look = explained();
  EXPECT_EQ(after_look.fate, PoseFate::kGivenUp);
  EXPECT_GT(after_look.look_balance, 0.5);
}

TEST_F(DetectorExplanation, explainsAPoseThatOthersWithMoreVotesKeptOut)
{
  DetectorConfig few = coarseConfig();
  few.max_candidates = 1;
  few.min_sparse_balance = few.min_look_balance = -2;
  const DetectionResult result = detect(few);
  ASSERT_FALSE(result.distribution.empty());
  const Eigen::Vector3f here = T_camera_bracket_.cast<float>() * bracket_.data().center;
  const PoseHypothesis& far =
      *std::max_element(result.distribution.begin(), result.distribution.end(),
                        [&](const auto& a, const auto& b)
                        { return (a.center - here).norm() < (b.center - here).norm(); });
  Eigen::Isometry3d T_camera_far = Eigen::Isometry3d::Identity();
  T_camera_far.linear() = far.rotation.cast<double>().toRotationMatrix();
  T_camera_far.translation() =
      far.center.cast<double>() - T_camera_far.linear() * bracket_.data().center.cast<double>();
  const auto fate_at = [&](const Eigen::Isometry3d& T_camera_model)
  { return Detector(few).explain(cloud(), bracket_, roi_, T_camera_model).fate; };
  EXPECT_EQ(fate_at(T_camera_bracket_), PoseFate::kReliable);
  EXPECT_EQ(fate_at(T_camera_far), PoseFate::kNoCandidate);
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/candidate_verification.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// A bracket before a wall, and candidates for it.
class VerifiedCandidates : public ::testing::Test
{
protected:
  void add(const Eigen::Isometry3d& T_camera_model, float votes)
  {
    Candidate candidate;
    candidate.T_camera_model = T_camera_model.cast<float>();
    candidate.votes = votes;
    candidates_.push_back(candidate);
  }

  void verify(const Deadline& deadline)
  {
    verifyCandidates(
        image_, {&model_}, config_, deadline, [](const char*) {}, candidates_);
  }

  std::vector<float> votes() const
  {
    std::vector<float> all;
    for (const Candidate& candidate : candidates_)
      all.push_back(candidate.votes);
    return all;
  }

  const Eigen::Isometry3d true_pose_ =
      poseOf(0.9, {0, 0, 1}, {0, 0, 0.5}) * poseOf(2.4, {0.8, 0.6, 0}, {0, 0, 0});
  const Eigen::Isometry3d before_all_ = Eigen::Translation3d(0, 0, -0.2) * true_pose_;
  const PpfModel model_ = coarselyTrained(bracketMesh());
  const RangeImage image_ = imageOf({wall(0.6), {bracketMesh(), true_pose_}}, 0.004F, 0.0001F);
  DetectorConfig config_;
  std::vector<Candidate> candidates_;
};

TEST_F(VerifiedCandidates, areRefinedAndKeepTheirOrderAndEvidence)
{
  for (int i = 0; i < 80; ++i)
    add(Eigen::Translation3d(0.0001 * i, 0, 0.001) * true_pose_, static_cast<float>(i % 7));
  const std::vector<float> given = votes();
  verify(Deadline(0, nullptr));
  EXPECT_EQ(votes(), given);
  for (const Candidate& candidate : candidates_)
  {
    EXPECT_TRUE(candidate.verified);
    EXPECT_GT(candidate.evidence.confirmed.size(), 200U);
    EXPECT_LT(
        (candidate.T_camera_model.translation() - true_pose_.translation().cast<float>()).norm(),
        0.002F);
  }
}

TEST_F(VerifiedCandidates, areGivenUpWhereTheQuickFitOrTheFirstLookContradictsThem)
{
  const auto left_at = [&](double min_sparse_balance, double min_look_balance)
  {
    config_.min_sparse_balance = min_sparse_balance;
    config_.min_look_balance = min_look_balance;
    candidates_.clear();
    add(before_all_, 3);
    add(true_pose_, 2);
    add(before_all_, 1);
    verify(Deadline(0, nullptr));
    return votes();
  };
  EXPECT_EQ(left_at(-2, -2), (std::vector<float>{3, 2, 1}));
  EXPECT_EQ(left_at(-1, -2), std::vector<float>{2});
  EXPECT_EQ(left_at(-2, -0.2), std::vector<float>{2});
  EXPECT_TRUE(candidates_.front().verified);
  EXPECT_GT(candidates_.front().evidence.confirmed.size(), 200U);
  EXPECT_TRUE(left_at(-2, 1).empty());
}

TEST_F(VerifiedCandidates, climbWhereTheyStandAndTheCloudSaysLittleForThem)
{
  const Eigen::Isometry3d beside = Eigen::Translation3d(0, -0.004, 0) * true_pose_;
  add(true_pose_, 3);
  add(beside, 2);
  add(beside, 1);
  for (Candidate& candidate : candidates_)
    candidate.evidence = gatherEvidence(image_, model_, candidate.T_camera_model, config_);
  const std::vector<SelectedPose> standing = {{0, 0, 0}, {1, 0, 0}};
  const std::atomic<bool> stop(true);
  EXPECT_FALSE(
      climbStanding(image_, {&model_}, config_, Deadline(0, &stop), standing, candidates_));
  EXPECT_EQ(candidates_[1].T_camera_model.matrix(), beside.cast<float>().matrix())
      << "the deadline has passed";
  EXPECT_TRUE(climbStanding(image_, {&model_}, config_, Deadline(), standing, candidates_));
  EXPECT_EQ(candidates_[0].T_camera_model.matrix(), true_pose_.cast<float>().matrix());
  EXPECT_EQ(candidates_[0].climbed, 0);
  EXPECT_NE(candidates_[1].T_camera_model.matrix(), beside.cast<float>().matrix());
  EXPECT_GT(candidates_[1].climbed, 0);
  EXPECT_EQ(candidates_[2].T_camera_model.matrix(), beside.cast<float>().matrix())
      << "does not stand";
}

TEST_F(VerifiedCandidates, doNotClimbOutOfALargerSurfaceThatTheyLieIn)
{
  // Parallel to the wall, and tilted into it so that its surface passes through the part.
  for (const double tilt_rad : {0.0, 0.1})
  {
    const Eigen::Isometry3d within =
        poseOf(M_PI + tilt_rad, {1, 0, 0}, {0.09, 0, 0.6}) * poseOf(0.3, {0, 0, 1}, {0, 0, 0});
    candidates_.clear();
    add(within, 1);
    Candidate& candidate = candidates_.front();
    candidate.evidence = gatherEvidence(image_, model_, candidate.T_camera_model, config_);
    climbStanding(image_, {&model_}, config_, Deadline(), {{0, 0, 0}}, candidates_);
    EXPECT_EQ(candidate.T_camera_model.matrix(), within.cast<float>().matrix()) << tilt_rad;
  }
}

TEST_F(VerifiedCandidates, stayAsTheyAreOnceTheDeadlineHasPassed)
{
  add(before_all_, 2);
  add(true_pose_, 1);
  const std::atomic<bool> stop(true);
  verify(Deadline(0, &stop));
  ASSERT_EQ(votes(), (std::vector<float>{2, 1}));
  for (const Candidate& candidate : candidates_)
    EXPECT_FALSE(candidate.verified);
  EXPECT_EQ(candidates_[1].T_camera_model.matrix(), true_pose_.cast<float>().matrix());
}
}  // namespace
}  // namespace ppf_bin_picking

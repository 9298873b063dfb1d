#include "ppf_bin_picking/core/ppf_matcher.hpp"

#include "support/brute_force.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
/// A coarse bracket, and a scene of its own points at a pose with strangers around it.
class PpfMatcherTest : public ::testing::Test
{
protected:
  PpfMatcherTest()
  {
    config_.model = model_.parameters();
    config_.reference_share = 1;
    std::mt19937 rng(8);
    truth_ = randomPose(rng, 0.3).cast<float>();
    for (std::size_t i = 0; i < model_.data().points.size(); ++i)
      scene_.add(truth_ * model_.data().points[i], truth_.linear() * model_.data().normals[i]);
    for (int i = 0; i < 40; ++i)
    {
      const Eigen::Vector3f stranger = truth_.translation() + randomPoint(rng, 0.08F);
      scene_.add(stranger, randomDirection(rng));
    }
  }

  static ModelParameters coarse() { return {0.15, 30}; }

  PpfModel model_ = PpfModel::train(bracketMesh(), SymmetryGroup(), coarse());
  DetectorConfig config_;
  Eigen::Isometry3f truth_ = Eigen::Isometry3f::Identity();  ///< About the part's centre.
  OrientedPoints scene_;
};

TEST_F(PpfMatcherTest, countsVotesLikeTheSlowTwin)
{
  const auto table = slowTable(model_.data());
  config_.peaks_per_reference = 1;
  for (const double lambda : {0.0, 0.6, 1.0})
  {
    SCOPED_TRACE(lambda);
    config_.lambda = lambda;
    config_.v_min = 0.3;
    std::vector<float> expected;
    for (std::size_t i = 0; i < scene_.size(); ++i)
    {
      const float votes = slowBestVotes(scene_, i, model_.data(), table, config_);
      if (votes > 0) expected.push_back(votes);
    }
    std::vector<float> votes;
    for (const PoseHypothesis& hypothesis : matchModel(scene_, model_, config_, Deadline()))
      votes.push_back(hypothesis.votes);
    EXPECT_EQ(votes, expected);
  }
}

TEST_F(PpfMatcherTest, votesForTheTruePose)
{
  const std::vector<PoseHypothesis> hypotheses = matchModel(scene_, model_, config_, Deadline());
  ASSERT_FALSE(hypotheses.empty());
  const PoseHypothesis& best = *std::max_element(
      hypotheses.begin(), hypotheses.end(),
      [](const PoseHypothesis& a, const PoseHypothesis& b) { return a.votes < b.votes; });
  EXPECT_LT((best.center - truth_.translation()).norm(), 0.1 * model_.diameter());
  EXPECT_LT(best.rotation.angularDistance(Eigen::Quaternionf(truth_.linear())), 0.15F);
}

TEST_F(PpfMatcherTest, movesItsHypothesesWithTheScene)
{
  config_.peaks_per_reference = 1;
  std::mt19937 rng(9);
  const Eigen::Isometry3f T = randomPose(rng, 0.2).cast<float>();
  OrientedPoints moved;
  for (std::size_t i = 0; i < scene_.size(); ++i)
    moved.add(T * scene_.points[i], T.linear() * scene_.normals[i]);
  const auto still = matchModel(scene_, model_, config_, Deadline());
  const auto turned = matchModel(moved, model_, config_, Deadline());
  // Alpha steps lie elsewhere after the turn, so that weak peaks may differ; the strong ones stay.
  std::size_t strong = 0, same = 0;
  for (const PoseHypothesis& hypothesis : still)
  {
    if ((hypothesis.center - truth_.translation()).norm() > 0.1 * model_.diameter()) continue;
    ++strong;
    same += std::any_of(turned.begin(), turned.end(),
                        [&](const PoseHypothesis& other)
                        {
                          return (other.center - T * hypothesis.center).norm() <
                                     0.1 * model_.diameter() &&
                                 other.rotation.angularDistance(Eigen::Quaternionf(T.linear()) *
                                                                hypothesis.rotation) < 0.3;
                        })
                ? 1
                : 0;
  }
  EXPECT_GT(strong, scene_.size() / 4);
  EXPECT_GE(same, strong * 95 / 100);
}

TEST_F(PpfMatcherTest, givesTheSameForAnyNumberOfThreads)
{
  config_.threads = 1;
  const auto one = matchModel(scene_, model_, config_, Deadline());
  for (const int threads : {2, 4, 0})
  {
    config_.threads = threads;
    const auto many = matchModel(scene_, model_, config_, Deadline());
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i)
    {
      EXPECT_TRUE(many[i].center == one[i].center);
      EXPECT_TRUE(many[i].rotation.coeffs() == one[i].rotation.coeffs());
      EXPECT_EQ(many[i].votes, one[i].votes);
    }
  }
}

TEST_F(PpfMatcherTest, keepsAsManyPeaksAsAsked)
{
  const std::size_t references = scene_.size();
  for (const int peaks : {1, 2, 5})
  {
    config_.peaks_per_reference = peaks;
    config_.peak_ratio = 0.3;
    const std::size_t found = matchModel(scene_, model_, config_, Deadline()).size();
    EXPECT_LE(found, peaks * references);
    EXPECT_GT(found, (peaks - 1) * references / 2);
  }
}

TEST_F(PpfMatcherTest, takesTheShareOfReferencePoints)
{
  config_.peaks_per_reference = 1;
  config_.reference_share = 0.1;
  const std::size_t found = matchModel(scene_, model_, config_, Deadline()).size();
  EXPECT_LE(found, scene_.size() / 10 + 1);
  EXPECT_GT(found, scene_.size() / 20);
}

TEST_F(PpfMatcherTest, findsNothingInAnEmptySceneOrAfterTheDeadline)
{
  EXPECT_TRUE(matchModel(OrientedPoints(), model_, config_, Deadline()).empty());
  const Deadline passed(1e-9);
  while (!passed.passed())
  {
  }
  EXPECT_TRUE(matchModel(scene_, model_, config_, passed).empty());
}

TEST(VoteWeight, fallsWithParallelNormals)
{
  const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY();
  EXPECT_EQ(voteWeight(x, x, 0, 0.1), kVoteUnit);
  EXPECT_EQ(voteWeight(x, y, 1, 0.1), kVoteUnit);
  EXPECT_EQ(voteWeight(x, x, 0.5, 0.1), kVoteUnit / 2);
  EXPECT_EQ(voteWeight(x, -x, 0.5, 0.1), kVoteUnit / 2);
  EXPECT_EQ(voteWeight(x, x, 1, 0.25), kVoteUnit / 4);
  EXPECT_EQ(voteWeight(x, x, 1, 1e-6), 1U);
}
}  // namespace
}  // namespace ppf_bin_picking

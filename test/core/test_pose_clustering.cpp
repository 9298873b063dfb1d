#include "ppf_bin_picking/core/pose_clustering.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
ModelParameters coarse()
{
  return {0.15, 30};
}

PoseHypothesis hypothesis(const Eigen::Vector3f& center, float votes,
                          const Eigen::Quaternionf& rotation = Eigen::Quaternionf::Identity())
{
  PoseHypothesis made;
  made.rotation = rotation;
  made.center = center;
  made.votes = votes;
  return made;
}

Eigen::Quaternionf turn(double angle_rad, const Eigen::Vector3f& axis)
{
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle_rad), axis));
}

/// Hypotheses all over a cube, turned by up to 0.8 rad; votes all different.
std::vector<PoseHypothesis> randomHypotheses(std::mt19937& rng, std::size_t count, float reach_m)
{
  std::vector<PoseHypothesis> hypotheses;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3f center = randomPoint(rng, reach_m);
    const Eigen::Vector3f axis = randomDirection(rng);
    hypotheses.push_back(hypothesis(center, static_cast<float>(1 + i * 7919 % count),
                                    turn(0.1 * static_cast<double>(i % 9), axis)));
  }
  return hypotheses;
}

/// The greedy rule word by word: take the strongest one left, with all that are near it.
std::vector<PoseGroup> slowGroups(std::vector<PoseHypothesis> left, const DetectorConfig& config,
                                  const PpfModel& model)
{
  std::vector<PoseGroup> groups;
  while (!left.empty())
  {
    const PoseHypothesis leader = *std::max_element(
        left.begin(), left.end(),
        [](const PoseHypothesis& a, const PoseHypothesis& b) { return a.votes < b.votes; });
    PoseGroup group;
    group.rotation = leader.rotation;
    std::vector<PoseHypothesis> rest;
    for (const PoseHypothesis& other : left)
    {
      const bool near =
          (other.center - leader.center).norm() <= config.group_distance_rel * model.diameter() &&
          model.symmetries().rotationDistance(leader.rotation, other.rotation) <=
              config.group_angle_rad;
      if (!near)
      {
        rest.push_back(other);
        continue;
      }
      group.center += other.votes * other.center;
      group.votes += other.votes;
      ++group.members;
    }
    group.center /= group.votes;
    groups.push_back(group);
    left = rest;
  }
  std::sort(groups.begin(), groups.end(),
            [](const PoseGroup& a, const PoseGroup& b) { return a.votes > b.votes; });
  return groups;
}

class PoseClustering : public ::testing::Test
{
protected:
  PoseClustering() { config_.model = coarse(); }

  DetectorConfig config_;
  PpfModel model_ = PpfModel::train(bracketMesh(), SymmetryGroup(), coarse());
};

TEST_F(PoseClustering, groupsLikeTheSlowTwin)
{
  std::mt19937 rng(41);
  for (int trial = 0; trial < 20; ++trial)
  {
    SCOPED_TRACE(trial);
    const std::vector<PoseHypothesis> hypotheses = randomHypotheses(rng, 150, 0.02F);
    const std::vector<PoseGroup> expected = slowGroups(hypotheses, config_, model_);
    const std::vector<PoseGroup> groups = groupPoses(config_, model_, hypotheses);
    ASSERT_EQ(groups.size(), expected.size());
    EXPECT_LT(groups.size(), hypotheses.size());
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
      EXPECT_EQ(groups[i].votes, expected[i].votes);
      const bool tied = (i > 0 && groups[i].votes == groups[i - 1].votes) ||
                        (i + 1 < groups.size() && groups[i].votes == groups[i + 1].votes);
      if (tied) continue;  // may have changed places
      EXPECT_EQ(groups[i].members, expected[i].members);
      EXPECT_LT((groups[i].center - expected[i].center).norm(), 1e-5F);
      EXPECT_TRUE(groups[i].rotation.coeffs() == expected[i].rotation.coeffs());
    }
  }
}

TEST_F(PoseClustering, groupsOrientationsThatTheSymmetryMakesOne)
{
  const SymmetryGroup half_turn({{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, M_PI}}, {});
  const PpfModel box = PpfModel::train(boxMesh({0.06F, 0.04F, 0.03F}), half_turn, coarse());
  const Eigen::Quaternionf base = turn(1, Eigen::Vector3f(1, 2, 3).normalized());
  const std::vector<PoseHypothesis> hypotheses = {
      hypothesis({0, 0, 1}, 3, base),
      hypothesis({0, 0, 1}, 2, base * turn(M_PI, Eigen::Vector3f::UnitZ())),
      hypothesis({0, 0, 1}, 1, base * turn(M_PI, Eigen::Vector3f::UnitX()))};
  const std::vector<PoseGroup> groups = groupPoses(config_, box, hypotheses);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].votes, 5);
  EXPECT_EQ(groups[1].votes, 1);
  EXPECT_EQ(groupPoses(config_, model_, hypotheses).size(), 3U);
}

TEST_F(PoseClustering, keepsTheHypothesesWithManyVotes)
{
  const std::vector<PoseHypothesis> hypotheses = {
      hypothesis({0, 0, 1}, 10), hypothesis({0, 0, 2}, 2), hypothesis({0, 0, 3}, 1.9F)};
  EXPECT_EQ(highVoteHypotheses(hypotheses, 0.2).size(), 2U);
  EXPECT_EQ(highVoteHypotheses(hypotheses, 0).size(), 3U);
  EXPECT_EQ(highVoteHypotheses(hypotheses, 1).size(), 1U);
  EXPECT_TRUE(highVoteHypotheses({}, 0.2).empty());
}

TEST_F(PoseClustering, describesItsClusters)
{
  config_.eps_rel = 0.1;
  config_.minpts = 3;
  const auto diameter = static_cast<float>(model_.diameter());
  std::vector<PoseHypothesis> hypotheses;
  for (int i = 0; i < 40; ++i)  // a row that is long compared with the part
    hypotheses.push_back(hypothesis({0.09F * diameter * static_cast<float>(i), 0, 1}, 1));
  for (int i = 0; i < 5; ++i)  // a small heap
    hypotheses.push_back(hypothesis({0, 0.01F * diameter * static_cast<float>(i), 2}, 1));
  hypotheses.push_back(hypothesis({0, 0, 5}, 9));  // alone

  const std::vector<HypothesisCluster> clusters = clusterHypotheses(config_, model_, hypotheses);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].hypotheses, 40U);
  EXPECT_TRUE(clusters[0].mismatching);
  EXPECT_NEAR(clusters[0].box.size.x(), 39 * 0.09 * diameter, 1e-4);
  EXPECT_EQ(clusters[1].hypotheses, 5U);
  EXPECT_FALSE(clusters[1].mismatching);
  EXPECT_EQ(hypotheses.front().cluster, 0);
  EXPECT_EQ(hypotheses[42].cluster, 1);
  EXPECT_EQ(hypotheses.back().cluster, -1);
}

TEST_F(PoseClustering, givesEachClusterItsCandidates)
{
  const Eigen::Vector3f far = Eigen::Vector3f::UnitZ();
  std::vector<PoseHypothesis> hypotheses;
  for (int i = 0; i < 3; ++i)
  {
    PoseHypothesis near_one =
        hypothesis(Eigen::Vector3f::Zero(), 5, turn(i, Eigen::Vector3f::UnitX()));
    PoseHypothesis far_one = hypothesis(far, static_cast<float>(6 + i), turn(i, far));
    near_one.cluster = 0;
    far_one.cluster = 1;
    hypotheses.push_back(near_one);
    hypotheses.push_back(far_one);
  }
  hypotheses.push_back(hypothesis(-far, 100));  // noise

  EXPECT_EQ(candidatePoses(config_, model_, hypotheses, 2).size(), 6U);
  config_.poses_per_cluster = 1;
  const std::vector<PoseGroup> best = candidatePoses(config_, model_, hypotheses, 2);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].votes, 8);
  EXPECT_EQ(best[0].cluster, 1);
  EXPECT_EQ(best[1].cluster, 0);
  config_.clustering = Clustering::kGreedy;
  const std::vector<PoseGroup> greedy = candidatePoses(config_, model_, hypotheses, 0);
  ASSERT_EQ(greedy.size(), 7U);
  EXPECT_EQ(greedy.front().votes, 100);
}

TEST_F(PoseClustering, takesItsSizesFromTheConfiguration)
{
  config_.eps_rel = 0.3;
  config_.minpts = 17;
  EXPECT_NEAR(dbscanRadius(config_, model_), 0.3 * model_.diameter(), 1e-9);
  EXPECT_EQ(dbscanCoreSize(config_, model_), 17U);
}
}  // namespace
}  // namespace ppf_bin_picking

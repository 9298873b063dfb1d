#include "ppf_bin_picking/core/mismatch.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
/// Hypotheses of a cluster every 0.1 m along x, from 0 on.
std::vector<PoseHypothesis> row(int count, std::int32_t cluster)
{
  std::vector<PoseHypothesis> hypotheses(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    hypotheses[static_cast<std::size_t>(i)].center = {0.1F * static_cast<float>(i), 0, 0};
    hypotheses[static_cast<std::size_t>(i)].cluster = cluster;
  }
  return hypotheses;
}

TEST(ShareClusters, givesALonePoseTheWholeCluster)
{
  const std::vector<ClusterShare> shares = shareClusters(row(11, 0), {{0.2F, 0, 0}}, {0});
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0].hypotheses, 11U);
  EXPECT_NEAR(shares[0].box.size.x(), 1.0, 1e-6);
}

TEST(ShareClusters, dividesAClusterByTheNearestPose)
{
  const std::vector<ClusterShare> shares =
      shareClusters(row(11, 0), {{0.2F, 0, 0}, {0.9F, 0, 0}}, {0, 0});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].hypotheses, 6U);  // 0 to 0.5
  EXPECT_EQ(shares[1].hypotheses, 5U);  // 0.6 to 1
  EXPECT_NEAR(shares[0].box.size.x(), 0.5, 1e-6);
  EXPECT_NEAR(shares[1].box.size.x(), 0.4, 1e-6);
}

TEST(ShareClusters, leavesOutOtherClustersAndNoise)
{
  std::vector<PoseHypothesis> hypotheses = row(5, 1);
  const std::vector<PoseHypothesis> noise = row(7, -1);
  hypotheses.insert(hypotheses.end(), noise.begin(), noise.end());
  const Eigen::Vector3f here = Eigen::Vector3f::Zero();
  const std::vector<ClusterShare> shares =
      shareClusters(hypotheses, {here, here, here}, {0, 1, -1});
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_EQ(shares[0].hypotheses, 0U);
  EXPECT_TRUE(shares[0].box.size.isZero());
  EXPECT_EQ(shares[1].hypotheses, 5U);
  EXPECT_EQ(shares[2].hypotheses, 0U);
}
}  // namespace
}  // namespace ppf_bin_picking

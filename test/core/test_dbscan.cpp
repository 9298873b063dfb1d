#include "ppf_bin_picking/core/dbscan.hpp"

#include "support/brute_force.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
using Points = std::vector<Eigen::Vector3f>;

Points onLine(const std::vector<float>& xs)
{
  Points points;
  for (const float x : xs)
    points.emplace_back(x, 0, 0);
  return points;
}

TEST(Dbscan, equalsTheSlowTwinOnRandomSets)
{
  std::mt19937 rng(21);
  std::uniform_int_distribution<std::size_t> count(0, 150), core_size(1, 8);
  std::uniform_real_distribution<float> radius(0.05F, 0.5F);
  for (int trial = 0; trial < 200; ++trial)
  {
    SCOPED_TRACE(trial);
    Points points(count(rng));
    for (Eigen::Vector3f& point : points)
      point = randomPoint(rng, 1);
    for (std::size_t i = 3; i < points.size(); i += 4)  // every fourth one twice
      points[i] = points[i / 2];
    const float eps = radius(rng);
    const std::size_t minpts = core_size(rng);
    EXPECT_EQ(dbscan(points, eps, minpts), slowDbscan(points, eps, minpts));
  }
}

TEST(Dbscan, equalsTheSlowTwinOnAGridWhereDistancesTie)
{
  std::mt19937 rng(22);
  std::uniform_int_distribution<int> cell(-4, 4);
  for (int trial = 0; trial < 100; ++trial)
  {
    SCOPED_TRACE(trial);
    Points points;
    for (int i = 0; i < 60; ++i)
    {
      const int x = cell(rng), y = cell(rng);
      points.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
    }
    for (const std::size_t minpts : {2U, 4U, 6U})
      EXPECT_EQ(dbscan(points, 1, minpts), slowDbscan(points, 1, minpts));
  }
}

TEST(Dbscan, takesThePointsOnTheBorderOfTheRadius)
{
  EXPECT_EQ(dbscan(onLine({0, 1, 2}), 1, 3), std::vector<std::int32_t>({0, 0, 0}));
  EXPECT_EQ(dbscan(onLine({0, 1, 2}), 0.999F, 2), std::vector<std::int32_t>(3, kNoise));
}

TEST(Dbscan, followsAChain)
{
  Points chain;
  for (int i = 0; i < 500; ++i)
    chain.emplace_back(0, 0, 0.9F * static_cast<float>(i));
  EXPECT_EQ(dbscan(chain, 1, 3), std::vector<std::int32_t>(500, 0));
}

TEST(Dbscan, givesABorderPointToTheFirstOfItsClusters)
{
  // The point at 0 lies within reach of a core point on either side and is none itself.
  const Points points = onLine({1, 1.1F, 1.2F, 0, -1, -1.1F, -1.2F});
  EXPECT_EQ(dbscan(points, 1, 4), std::vector<std::int32_t>({0, 0, 0, 0, 1, 1, 1}));
}

TEST(Dbscan, copesWithFewPoints)
{
  EXPECT_TRUE(dbscan({}, 1, 1).empty());
  EXPECT_EQ(dbscan(onLine({5}), 1, 1), std::vector<std::int32_t>({0}));
  EXPECT_EQ(dbscan(onLine({5}), 1, 2), std::vector<std::int32_t>({kNoise}));
  EXPECT_EQ(dbscan(Points(50, Eigen::Vector3f::Ones()), 1e-6F, 50),
            std::vector<std::int32_t>(50, 0));
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/neighbor_search.hpp"

#include "support/brute_force.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
std::vector<Eigen::Vector3f> randomPoints(std::mt19937& rng, std::size_t count)
{
  std::vector<Eigen::Vector3f> points(count);
  for (Eigen::Vector3f& point : points)
    point = randomPoint(rng, 1);
  for (std::size_t i = 5; i < count; i += 7)
    points[i] = points[i - 5];
  return points;
}

TEST(NeighborSearch, findsAllWithinTheRadius)
{
  std::mt19937 rng(51);
  std::vector<std::uint32_t> found = {7};  // is overwritten
  for (const std::size_t count : {0U, 1U, 9U, 10U, 11U, 500U})
  {
    SCOPED_TRACE(count);
    const auto points = randomPoints(rng, count);
    const NeighborSearch search(points);
    for (const float radius : {1e-6F, 0.1F, 0.5F, 4.0F})
      for (std::size_t trial = 0; trial < 20; ++trial)
      {
        const bool anywhere = trial % 2 == 0 || points.empty();
        const Eigen::Vector3f query = anywhere ? randomPoint(rng, 1.5F) : points[trial % count];
        search.within(query, radius, found);
        EXPECT_EQ(found, slowWithin(points, query, radius));
      }
  }
}

TEST(NeighborSearch, takesPointsOnTheBorder)
{
  const std::vector<Eigen::Vector3f> points = {{3, 4, 0}, {0, 5, 0}, {0, 0, 5.001F}};
  std::vector<std::uint32_t> found;
  NeighborSearch(points).within(Eigen::Vector3f::Zero(), 5, found);
  EXPECT_EQ(found, std::vector<std::uint32_t>({0, 1}));
}

TEST(NeighborSearch, findsTheNearest)
{
  std::mt19937 rng(52);
  const auto points = randomPoints(rng, 300);
  const NeighborSearch search(points);
  std::vector<std::pair<std::uint32_t, float>> found;
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Vector3f query = randomPoint(rng, 1.2F);
    std::vector<float> expected;
    for (const Eigen::Vector3f& point : points)
      expected.push_back((point - query).squaredNorm());
    std::sort(expected.begin(), expected.end());
    search.nearest(query, 8, found);
    ASSERT_EQ(found.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
    {
      EXPECT_NEAR(found[i].second, expected[i], 1e-6);
      EXPECT_NEAR((points[found[i].first] - query).squaredNorm(), expected[i], 1e-6);
    }
  }
}

TEST(NeighborSearch, givesFewerIfThereAreFewer)
{
  const std::vector<Eigen::Vector3f> points(3, Eigen::Vector3f::Ones());
  std::vector<std::pair<std::uint32_t, float>> found;
  NeighborSearch(points).nearest(Eigen::Vector3f::Zero(), 10, found);
  EXPECT_EQ(found.size(), 3U);
}
}  // namespace
}  // namespace ppf_bin_picking

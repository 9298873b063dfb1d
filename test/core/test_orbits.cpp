#include "ppf_bin_picking/core/orbits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kStep_m = 0.1F;
const Eigen::Vector3f kCenter(0.5F, -0.2F, 1.0F);  // of the part, in its mesh's frame

/// Samples on a sphere of 1 m around the part's centre, with normals outwards.
OrientedPoints sphereSamples()
{
  OrientedPoints samples;
  for (int i = 0; i < 1000; ++i)
  {
    const float z = 1 - (static_cast<float>(i) + 0.5F) / 500;
    const float turn = 2.3999632F * static_cast<float>(i);  // golden angle
    const float radius = std::sqrt(1 - z * z);
    const Eigen::Vector3f p(radius * std::cos(turn), radius * std::sin(turn), z);
    samples.add(p, p);
  }
  return samples;
}

SymmetryAxis axisThroughCenter(const Eigen::Vector3d& direction)
{
  return {direction, kCenter.cast<double>()};
}

/// Distance from a point, moved by all symmetries, to the nearest of the first samples.
float farthestUncovered(const SymmetryGroup& symmetries, const OrientedPoints& all,
                        const OrientedPoints& sorted, std::size_t count)
{
  float farthest = 0;
  for (const Eigen::Vector3f& point : all.points)
  {
    float nearest = 10;
    for (const Eigen::Isometry3d& motion : symmetries.motions())
    {
      const Eigen::Vector3f image = motion.cast<float>() * (point + kCenter) - kCenter;
      for (std::size_t i = 0; i < count; ++i)
        nearest = std::min(nearest, (image - sorted.points[i]).norm());
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(MoveRepresentativesToFront, keepsAllInOrderWithoutSymmetries)
{
  OrientedPoints samples = sphereSamples();
  EXPECT_EQ(moveRepresentativesToFront(SymmetryGroup(), kCenter, kStep_m, samples), 1000U);
  EXPECT_EQ(samples.points, sphereSamples().points);
  EXPECT_EQ(samples.normals, sphereSamples().normals);
}

TEST(MoveRepresentativesToFront, coversAllByOneDomainOfDiscreteSymmetries)
{
  const SymmetryGroup sixth({{axisThroughCenter({0, 0, 1}), M_PI / 3}}, {});
  OrientedPoints samples = sphereSamples();
  const std::size_t count = moveRepresentativesToFront(sixth, kCenter, kStep_m, samples);
  EXPECT_NEAR(static_cast<double>(count), 1000.0 / 6, 25);
  EXPECT_LT(farthestUncovered(sixth, sphereSamples(), samples, count), kStep_m);
}

TEST(MoveRepresentativesToFront, losesNoSample)
{
  const SymmetryGroup half({{axisThroughCenter({1, 0, 0}), M_PI}}, {});
  OrientedPoints samples = sphereSamples();
  moveRepresentativesToFront(half, kCenter, kStep_m, samples);
  const OrientedPoints before = sphereSamples();
  ASSERT_EQ(samples.size(), before.size());
  for (const Eigen::Vector3f& point : before.points)
    EXPECT_EQ(std::count(samples.points.begin(), samples.points.end(), point), 1);
}

TEST(MoveRepresentativesToFront, takesOneOfEachCircleOfARevolution)
{
  const SymmetryGroup revolution({}, {axisThroughCenter({0, 0, 1})});
  OrientedPoints samples = sphereSamples();
  const std::size_t count = moveRepresentativesToFront(revolution, kCenter, kStep_m, samples);
  EXPECT_LT(count, 80U);  // a half circle of pi in half steps
  for (const Eigen::Vector3f& point : samples.points)
  {
    const auto near = [&](const Eigen::Vector3f& known)
    { return std::abs(known.z() - point.z()) < 0.51F * kStep_m; };
    EXPECT_TRUE(std::any_of(samples.points.begin(),
                            samples.points.begin() + static_cast<std::ptrdiff_t>(count), near));
  }
}

TEST(MoveRepresentativesToFront, keepsCirclesWhoseNormalsDiffer)
{
  OrientedPoints samples;
  samples.add({1, 0, 0}, {0, 0, 1});
  samples.add({0, 1, 0}, {0, 0, -1});  // the other side of a thin disc
  samples.add({0, -1, 0}, {0, 0, 1});
  const SymmetryGroup revolution({}, {axisThroughCenter({0, 0, 1})});
  EXPECT_EQ(moveRepresentativesToFront(revolution, kCenter, kStep_m, samples), 2U);
}

TEST(MoveRepresentativesToFront, takesSomeOfASphereFromAllOverIt)
{
  const SymmetryGroup sphere({}, {axisThroughCenter({0, 0, 1}), axisThroughCenter({1, 0, 0})});
  OrientedPoints samples = sphereSamples();
  EXPECT_EQ(moveRepresentativesToFront(sphere, kCenter, kStep_m, samples), 32U);
  EXPECT_GT(samples.points[0].z(), 0.9F);
  EXPECT_LT(samples.points[31].z(), -0.9F);
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/symmetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
DiscreteSymmetry turn(const Eigen::Vector3d& axis, double angle_rad,
                      const Eigen::Vector3d& point = Eigen::Vector3d::Zero())
{
  return {{axis, point}, angle_rad};
}

TEST(SymmetryGroup, holdsTheIdentityAlone)
{
  const SymmetryGroup group;
  ASSERT_EQ(group.motions().size(), 1U);
  EXPECT_TRUE(group.motions().front().isApprox(Eigen::Isometry3d::Identity()));
}

TEST(SymmetryGroup, closesTheGenerators)
{
  const SymmetryGroup box({turn({1, 0, 0}, M_PI), turn({0, 1, 0}, M_PI)}, {});
  EXPECT_EQ(box.motions().size(), 4U);
  const SymmetryGroup nut({turn({0, 0, 2}, M_PI / 3), turn({1, 0, 0}, M_PI)}, {});
  EXPECT_EQ(nut.motions().size(), 12U);
}

TEST(SymmetryGroup, keepsThePointOfTheLineInPlace)
{
  const Eigen::Vector3d point(0.04, 0.018, 0);
  const SymmetryGroup group({turn({0, 0, 1}, M_PI, point)}, {});
  for (const Eigen::Isometry3d& motion : group.motions())
    EXPECT_NEAR((motion * point - point).norm(), 0, 1e-12);
}

TEST(SymmetryGroup, refusesAnAngleWithoutEnd)
{
  EXPECT_THROW(SymmetryGroup({turn({0, 0, 1}, 1.0)}, {}), std::invalid_argument);
}

TEST(SymmetryGroup, refusesAnAxisWithoutLength)
{
  EXPECT_THROW(SymmetryGroup({turn({0, 0, 0}, M_PI)}, {}), std::invalid_argument);
  EXPECT_THROW(SymmetryGroup({}, {{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}}),
               std::invalid_argument);
}

TEST(RotationDistance, isZeroForSymmetricOrientations)
{
  const SymmetryGroup nut({turn({0, 0, 1}, M_PI / 3), turn({1, 0, 0}, M_PI)}, {});
  std::mt19937 rng(3);
  std::normal_distribution<float> normal;
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Quaternionf a =
        Eigen::Quaternionf(normal(rng), normal(rng), normal(rng), normal(rng)).normalized();
    for (const Eigen::Isometry3d& motion : nut.motions())
      EXPECT_LT(nut.rotationDistance(a, a * Eigen::Quaternionf(motion.linear().cast<float>())),
                2e-3);
    const Eigen::Quaternionf off(Eigen::AngleAxisf(0.2F, Eigen::Vector3f::UnitZ()));
    EXPECT_NEAR(nut.rotationDistance(a, a * off), 0.2, 1e-3);
  }
}

TEST(RotationDistance, comparesAxesOfRevolution)
{
  const SymmetryGroup pin({}, {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}});
  const Eigen::Quaternionf a = Eigen::Quaternionf::Identity();
  EXPECT_NEAR(pin.rotationDistance(
                  a, Eigen::Quaternionf(Eigen::AngleAxisf(1.0F, Eigen::Vector3f::UnitX()))),
              0, 1e-3);
  const Eigen::Quaternionf end_for_end(
      Eigen::AngleAxisf(static_cast<float>(M_PI), Eigen::Vector3f::UnitZ()));
  EXPECT_NEAR(pin.rotationDistance(a, end_for_end), M_PI, 1e-3);
  const SymmetryGroup rod({turn({0, 0, 1}, M_PI)},
                          {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}});
  EXPECT_NEAR(rod.rotationDistance(a, end_for_end), 0, 1e-3);
}

TEST(RotationDistance, isZeroForASphere)
{
  const SymmetryGroup sphere({}, {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()},
                                  {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}});
  const Eigen::Quaternionf turned(Eigen::AngleAxisf(1.3F, Eigen::Vector3f(1, 2, 3).normalized()));
  EXPECT_EQ(sphere.rotationDistance(Eigen::Quaternionf::Identity(), turned), 0);
}
}  // namespace
}  // namespace ppf_bin_picking

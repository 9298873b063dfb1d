#include "ppf_bin_picking/core/self_distance.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"

#include "support/mesh_geometry.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
TEST(SelfDistance, isThatOfTheFarthestSample)
{
  const TriangleMesh mesh = bracketMesh();
  const SelfDistance self(mesh);
  std::mt19937 rng(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial)
  {
    SCOPED_TRACE(trial);
    const Eigen::Vector3d axis = Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    const Eigen::Isometry3d motion =
        turnAbout({axis.normalized(), Eigen::Vector3d(0.01, 0, 0.005)}, 0.1 * (trial + 1));
    constexpr std::size_t kSamples = 300;
    double slow = 0;
    for (std::size_t i = 0; i < kSamples; ++i)
      slow =
          std::max(slow, surfaceDistance(mesh, motion * self.surface().points[i].cast<double>()));
    EXPECT_NEAR(self.deviation(motion, INFINITY, kSamples), slow, 1e-6 + 0.02 * slow);
  }
}

TEST(SelfDistance, isZeroForASymmetry)
{
  const SelfDistance self(boxMesh({0.06F, 0.04F, 0.02F}));
  EXPECT_LT(self.deviation(Eigen::Isometry3d::Identity()), 1e-6);
  EXPECT_LT(self.deviation(turnAbout({Eigen::Vector3d::UnitY(), {0, 0, 0}}, M_PI)), 1e-6);
  EXPECT_GT(self.deviation(turnAbout({Eigen::Vector3d::UnitY(), {0, 0, 0}}, M_PI / 2)), 0.005);
}

TEST(SelfDistance, leavesOutWhatLiesHidden)
{
  const TriangleMesh box = boxMesh({0.06F, 0.04F, 0.02F});
  const SelfDistance self(joined({box, shifted(boxMesh({0.01F, 0.01F, 0.01F}), {0.02F, 0, 0})}));
  EXPECT_LT(self.deviation(turnAbout({Eigen::Vector3d::UnitZ(), {0, 0, 0}}, M_PI)), 1e-6);
}

TEST(SelfDistance, refinesAMotionToTheSymmetryNearIt)
{
  const SelfDistance self(boxMesh({0.06F, 0.04F, 0.02F}));
  const Eigen::Vector3d axis = Eigen::Vector3d(0.02, -0.01, 1).normalized();
  const Eigen::Isometry3d near = turnAbout({axis, {0.0005, 0.0003, 0}}, M_PI);
  const Eigen::Isometry3d exact = turnAbout({Eigen::Vector3d::UnitZ(), {0, 0, 0}}, M_PI);
  EXPECT_TRUE(self.refined(near, 0.003).isApprox(exact, 1e-4));
}
}  // namespace
}  // namespace ppf_bin_picking

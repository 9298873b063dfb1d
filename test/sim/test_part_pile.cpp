#include "ppf_bin_picking/sim/part_pile.hpp"
#include "ppf_bin_picking/sim/ray_caster.hpp"

#include "support/overlap.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace ppf_bin_picking
{
namespace
{
std::vector<Eigen::Isometry3d> dropped(const TriangleMesh& part, int count, std::uint32_t seed,
                                       const Bin& bin = {})
{
  PartPile pile(bin, part, convexHulls(part));
  pile.drop(count, seed);
  return pile.poses();
}

void expectInside(const Bin& bin, const TriangleMesh& part,
                  const std::vector<Eigen::Isometry3d>& poses)
{
  for (const Eigen::Isometry3d& T_bin_part : poses)
    for (const Eigen::Vector3f& vertex : part.vertices)
    {
      const Eigen::Vector3d p = T_bin_part * vertex.cast<double>();
      EXPECT_LT(std::abs(p.x()), bin.size_m.x() / 2 + 0.001);
      EXPECT_LT(std::abs(p.y()), bin.size_m.y() / 2 + 0.001);
      EXPECT_GT(p.z(), -0.001);
    }
}

double deepest(const std::vector<double>& overlaps)
{
  return *std::max_element(overlaps.begin(), overlaps.end());
}

TEST(PartPile, comesToRestInTheBin)
{
  const Bin bin{{0.2, 0.15, 0.2}, 0.004};
  const TriangleMesh part = angleMesh();
  PartPile pile(bin, part, convexHulls(part));
  pile.drop(10, 1);
  const auto poses = pile.poses();
  ASSERT_EQ(poses.size(), 10U);
  expectInside(bin, part, poses);
  EXPECT_LT(deepest(deepestOverlaps(bin, part, poses, 0.002F)), 0.001);
  pile.wake();
  pile.simulate(2);
  const auto awake = pile.poses();
  for (std::size_t k = 0; k < poses.size(); ++k)
    EXPECT_LT(furthestMove(part, poses[k], awake[k]), 0.0002) << "part " << k;
}

void expectSame(const std::vector<Eigen::Isometry3d>& poses,
                const std::vector<Eigen::Isometry3d>& others)
{
  ASSERT_EQ(poses.size(), others.size());
  for (std::size_t k = 0; k < poses.size(); ++k)
    EXPECT_EQ(poses[k].matrix(), others[k].matrix()) << "part " << k;  // every bit
}

/// Else that a pile stayed as it was says nothing.
void expectMovesOnceWoken(PartPile& pile)
{
  const auto asleep = pile.poses();
  pile.wake();
  pile.simulate(1);
  const auto awake = pile.poses();
  bool moved = false;
  for (std::size_t k = 0; k < asleep.size(); ++k)
    moved = moved || asleep[k].matrix() != awake[k].matrix();
  EXPECT_TRUE(moved);
}

TEST(PartPile, sleepsUntilItIsWoken)
{
  const TriangleMesh part = angleMesh();
  PartPile pile({{0.2, 0.15, 0.2}, 0.004}, part, convexHulls(part));
  pile.drop(8, 1);
  const auto asleep = pile.poses();
  pile.settle();
  pile.simulate(1);
  expectSame(asleep, pile.poses());
  expectMovesOnceWoken(pile);
}

TEST(PartPile, leavesAloneWhatDoesNotTouchThePartTakenOut)
{
  const TriangleMesh part = angleMesh();
  PartPile pile({{1, 1, 0.1}, 0.004}, part, convexHulls(part));
  pile.drop(4, 1);
  auto before = pile.poses();
  for (std::size_t k = 1; k < before.size(); ++k)
    ASSERT_GT((before[k].translation() - before[0].translation()).norm(), 0.1);
  pile.remove(0);
  before.erase(before.begin());
  pile.settle();
  expectSame(before, pile.poses());
  expectMovesOnceWoken(pile);
}

TEST(PartPile, wakesWhatAPartFallsOnto)
{
  const TriangleMesh part = angleMesh();
  PartPile pile({{0.1, 0.08, 0.2}, 0.004}, part, convexHulls(part));
  pile.drop(5, 1);
  const auto before = pile.poses();
  pile.drop(5, 2);
  const auto after = pile.poses();
  double furthest = 0;
  for (std::size_t k = 0; k < before.size(); ++k)
    furthest = std::max(furthest, furthestMove(part, before[k], after[k]));
  EXPECT_GT(furthest, 0.001);
}

TEST(PartPile, leavesNothingHangingOverTheRim)
{
  // Staples start on end and fall over the low walls; some would stay there, astride.
  const Bin bin{{0.07, 0.06, 0.03}, 0.004};
  const TriangleMesh part = joined({boxMesh({0.08F, 0.01F, 0.01F}),
                                    shifted(boxMesh({0.01F, 0.01F, 0.03F}), {0.035F, 0, 0.02F}),
                                    shifted(boxMesh({0.01F, 0.01F, 0.03F}), {-0.035F, 0, 0.02F})});
  const ConvexHulls hulls = convexHulls(part);
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    PartPile pile(bin, part, hulls);
    pile.drop(1, seed);
    const Eigen::Isometry3d T_bin_part = pile.poses().front();
    for (const Eigen::Vector3f& vertex : part.vertices)
    {
      const Eigen::Vector3d p = T_bin_part * vertex.cast<double>();
      const double beyond_m = std::max(std::abs(p.x()) - 0.039, std::abs(p.y()) - 0.034);
      EXPECT_FALSE(beyond_m > 0 && p.z() < 0.03) << "seed " << seed << "\n" << p;
    }
  }
}

TEST(PartPile, laysABoxOnOneOfItsFaces)
{
  const Eigen::Vector3f size(0.05F, 0.03F, 0.01F);
  for (std::uint32_t seed = 0; seed < 8; ++seed)
  {
    const Eigen::Isometry3d pose = dropped(boxMesh(size), 1, seed).front();
    double nearest = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double tilt = 1 - std::abs(pose.linear()(2, axis));
      nearest = std::min(nearest, std::abs(pose.translation().z() - size[axis] / 2.0) + tilt);
    }
    EXPECT_LT(nearest, 0.0005) << "seed " << seed << "\n" << pose.matrix();
  }
}

TEST(PartPile, bringsASphereToRestOnTheFloor)
{
  const Eigen::Isometry3d pose = dropped(sphereMesh(0.015F), 1, 3).front();
  EXPECT_NEAR(pose.translation().z(), 0.015, 0.0006);
}

TEST(PartPile, doesNotLetThinPlatesThrough)
{
  const Bin bin{{0.12, 0.1, 0.2}, 0.004};
  const TriangleMesh plate = boxMesh({0.06F, 0.04F, 0.001F});
  const auto poses = dropped(plate, 8, 2, bin);
  expectInside(bin, plate, poses);
  EXPECT_LT(deepest(deepestOverlaps(bin, plate, poses, 0.002F)), 0.0005);
}

TEST(PartPile, repeatsItselfForASeedWhateverElseRuns)
{
  const TriangleMesh part = angleMesh();
  const ConvexHulls hulls = convexHulls(part);
  const auto run = [&](std::uint32_t seed)
  {
    PartPile pile({}, part, hulls);
    pile.drop(8, seed);
    pile.remove(2);
    pile.settle();
    pile.drop(1, seed + 1);
    return pile.poses();
  };
  const auto first = run(11);
  ASSERT_EQ(first.size(), 8U);
  std::vector<Eigen::Isometry3d> beside, other;
  std::thread thread([&] { other = run(12); });
  beside = run(11);
  thread.join();
  expectSame(first, beside);
  EXPECT_NE(first[0].matrix(), other[0].matrix());
}

TEST(PartPile, letsTheRestFallWhereAPartWasTakenOut)
{
  // A narrow shaft, in which plates lie on each other.
  const TriangleMesh plate = boxMesh({0.06F, 0.05F, 0.02F});
  PartPile pile({{0.068, 0.066, 0.2}, 0.004}, plate, convexHulls(plate));
  pile.drop(3, 1);
  auto before = pile.poses();
  const auto height = [](const auto& pose) { return pose.translation().z(); };
  const auto lowest =
      std::min_element(before.begin(), before.end(),
                       [&](const auto& a, const auto& b) { return height(a) < height(b); });
  pile.remove(static_cast<std::size_t>(lowest - before.begin()));
  before.erase(lowest);
  expectSame(before, pile.poses());  // nothing moves before settle()
  pile.settle();
  const auto after = pile.poses();
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t k = 0; k < after.size(); ++k)
    EXPECT_LT(height(after[k]), height(before[k]) - 0.015);
}

TEST(PartPile, refusesWhatCannotWork)
{
  const TriangleMesh part = angleMesh();
  const ConvexHulls hulls = convexHulls(part);
  EXPECT_THROW(PartPile({{0.04, 0.04, 0.04}, 0.004}, part, hulls).drop(1, 1),
               std::invalid_argument);
  // There is room for one of these.
  const TriangleMesh sphere = sphereMesh(0.015F);
  EXPECT_THROW(PartPile({{0.035, 0.035, 0.001}, 0.004}, sphere, convexHulls(sphere)).drop(2, 1),
               std::invalid_argument);
  EXPECT_THROW(PartPile({}, part, {}), std::invalid_argument);
  EXPECT_THROW(PartPile({}, part, hulls).remove(0), std::out_of_range);
  PhysicsSettings settings;
  settings.step_s = 0;
  settings.restitution = 1;
  settings.static_friction_rel = 0.9;
  try
  {
    const PartPile pile({}, part, hulls, settings);
    FAIL() << "no error";
  }
  catch (const std::invalid_argument& error)
  {
    const std::string text = error.what();
    EXPECT_NE(text.find("step_s"), std::string::npos);
    EXPECT_NE(text.find("restitution"), std::string::npos);
    EXPECT_NE(text.find("static_friction_rel"), std::string::npos);
  }
}

TEST(BinMesh, isWoundOutwards)
{
  const Bin bin{{0.2, 0.1, 0.05}, 0.01};
  const TriangleMesh mesh = binMesh(bin);
  const RayCaster caster({{&mesh, Eigen::Isometry3d::Identity()}});
  const Eigen::Vector3f middle(0, 0, 0.02F);
  const std::vector<std::pair<Eigen::Vector3f, float>> rays = {{{1, 0, 0}, 0.1F},
                                                               {{-1, 0, 0}, 0.1F},
                                                               {{0, 1, 0}, 0.05F},
                                                               {{0, -1, 0}, 0.05F},
                                                               {{0, 0, -1}, 0.02F}};
  for (const auto& [direction, distance] : rays)
  {
    const auto hit = caster.cast(middle, direction);
    ASSERT_TRUE(hit) << direction.transpose();
    EXPECT_NEAR(hit->distance_m, distance, 1e-6);
    EXPECT_NEAR(hit->normal.dot(direction), -1, 1e-6);
  }
  EXPECT_FALSE(caster.cast(middle, Eigen::Vector3f::UnitZ()));
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/sim/bin_filling.hpp"
#include "ppf_bin_picking/sim/random.hpp"
#include "ppf_bin_picking/sim/ray_caster.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace ppf_bin_picking
{
namespace
{
/// How deep a point lies inside a closed mesh [m]; 0 outside.
double depthInside(const RayCaster& mesh, const Eigen::Vector3f& point)
{
  double depth = std::numeric_limits<double>::infinity();
  Random random(1);
  for (int trial = 0; trial < 60; ++trial)
  {
    const Eigen::Vector3f direction = random.direction().cast<float>();
    const auto hit = mesh.cast(point, direction);
    if (!hit || hit->normal.dot(direction) < 0) return 0;
    depth = std::min(depth, static_cast<double>(hit->distance_m));
  }
  return depth;
}

/// The mesh's corners and points spread over its triangles.
std::vector<Eigen::Vector3f> surfacePoints(const TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3f> points = mesh.vertices;
  Random random(2);
  for (const auto& triangle : mesh.triangles)
    for (int sample = 0; sample < 40; ++sample)
    {
      Eigen::Vector3f share = (random.direction().cwiseAbs2()).cast<float>();  // adds up to 1
      points.push_back(share.x() * mesh.vertices[triangle[0]] +
                       share.y() * mesh.vertices[triangle[1]] +
                       share.z() * mesh.vertices[triangle[2]]);
    }
  return points;
}

double deepestOverlap(const TriangleMesh& part, const std::vector<Eigen::Isometry3d>& poses)
{
  const RayCaster caster({{&part, Eigen::Isometry3d::Identity()}});
  const auto points = surfacePoints(part);
  double deepest = 0;
  for (const Eigen::Isometry3d& a : poses)
    for (const Eigen::Isometry3d& b : poses)
    {
      if (&a == &b) continue;
      const Eigen::Isometry3f T_a_b = (a.inverse() * b).cast<float>();
      for (const Eigen::Vector3f& point : points)
        deepest = std::max(deepest, depthInside(caster, T_a_b * point));
    }
  return deepest;
}

TEST(FillBin, laysPartsInsideWithoutSharedSpace)
{
  const Bin bin;
  const TriangleMesh part = angleMesh();
  for (const std::uint32_t seed : {1U, 2U, 3U})
  {
    SCOPED_TRACE(seed);
    const auto poses = fillBin(bin, part, 15, seed);
    ASSERT_EQ(poses.size(), 15U);
    for (const Eigen::Isometry3d& T_bin_part : poses)
      for (const Eigen::Vector3f& vertex : part.vertices)
      {
        const Eigen::Vector3d p = T_bin_part * vertex.cast<double>();
        EXPECT_LT(std::abs(p.x()), bin.size_m.x() / 2);
        EXPECT_LT(std::abs(p.y()), bin.size_m.y() / 2);
        EXPECT_GT(p.z(), -1e-6);
      }
    EXPECT_LT(deepestOverlap(part, poses), 0.0005);
  }
}

TEST(DeepestOverlap, seesPartsThatShareSpace)
{
  const std::vector<Eigen::Isometry3d> poses = {
      Eigen::Isometry3d::Identity(), Eigen::Isometry3d(Eigen::Translation3d(0.003, 0.001, 0.002))};
  EXPECT_GT(deepestOverlap(angleMesh(), poses), 0.001);
}

TEST(FillBin, pilesWhatDoesNotFitBesideEachOther)
{
  const auto poses = fillBin({{0.09, 0.09, 0.1}, 0.004}, angleMesh(), 8, 4);
  double highest = 0;
  for (const auto& pose : poses)
    highest = std::max(highest, pose.translation().z());
  EXPECT_GT(highest, 0.03);
  EXPECT_LT(deepestOverlap(angleMesh(), poses), 0.0005);
}

TEST(FillBin, restsPartsOnTheirFaces)
{
  const Eigen::Vector3f size(0.05F, 0.03F, 0.01F);
  for (std::uint32_t seed = 0; seed < 10; ++seed)
  {
    const Eigen::Isometry3d pose = fillBin({}, boxMesh(size), 1, seed).front();
    double nearest = 1;
    for (int axis = 0; axis < 3; ++axis)
      nearest = std::min(nearest, std::abs(pose.translation().z() - size[axis] / 2.0));
    EXPECT_LT(nearest, 1e-4) << "seed " << seed << ", height " << pose.translation().z();
  }
}

TEST(FillBin, repeatsItselfForASeed)
{
  const auto first = fillBin({}, angleMesh(), 6, 11);
  const auto again = fillBin({}, angleMesh(), 6, 11);
  const auto other = fillBin({}, angleMesh(), 6, 12);
  for (std::size_t k = 0; k < first.size(); ++k)
    EXPECT_EQ(first[k].matrix(), again[k].matrix());  // every bit
  EXPECT_NE(first[0].matrix(), other[0].matrix());
}

TEST(FillBin, refusesWhatCannotWork)
{
  EXPECT_THROW(fillBin({{0.04, 0.04, 0.04}, 0.004}, angleMesh(), 1, 1), std::invalid_argument);
  TriangleMesh inside_out = angleMesh();
  for (auto& triangle : inside_out.triangles)
    std::swap(triangle[0], triangle[1]);
  EXPECT_THROW(fillBin({}, inside_out, 1, 1), std::invalid_argument);
  TriangleMesh broken = angleMesh();
  broken.triangles[0][0] = 1000;
  EXPECT_THROW(RayCaster({{&broken, Eigen::Isometry3d::Identity()}}), std::invalid_argument);
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

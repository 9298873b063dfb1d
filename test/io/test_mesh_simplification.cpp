#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "ppf_bin_picking/io/mesh_simplification.hpp"

#include "support/mesh_geometry.hpp"
#include "support/shapes.hpp"
#include "support/subdivision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr float kRadius_m = 0.04F;

double area(const TriangleMesh& mesh)
{
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    sum += 0.5 * areaNormal(corners(mesh, i)).norm();
  return sum;
}

/// The largest distance of some places on a mesh from another mesh [m].
double deviation(const TriangleMesh& mesh, const TriangleMesh& from)
{
  double largest = 0;
  for (const Eigen::Vector3d& place : spreadPoints(mesh, 400))
    largest = std::max(largest, surfaceDistance(from, place));
  return largest;
}

void expectTheSameShape(const TriangleMesh& simple, const TriangleMesh& mesh)
{
  const double tolerance_m = 0.001 * meshDiameter(mesh);
  EXPECT_LE(deviation(simple, mesh), tolerance_m);
  EXPECT_LE(deviation(mesh, simple), tolerance_m);
}

TEST(Decimated, leavesASmallMeshAlone)
{
  const TriangleMesh mesh = sphereMesh(kRadius_m);
  const TriangleMesh same = decimated(mesh, mesh.triangles.size());
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(same.vertices.size(), mesh.vertices.size());
}

TEST(Decimated, keepsTheShapeOfALargeOne)
{
  const TriangleMesh mesh = sphereMesh(kRadius_m);
  const TriangleMesh simple = decimated(mesh, 2000);
  EXPECT_LE(simple.triangles.size(), 2000U);
  EXPECT_GT(simple.triangles.size(), 1900U);
  EXPECT_NEAR(area(simple), area(mesh), 0.01 * area(mesh));
  for (const Eigen::Vector3f& vertex : simple.vertices)
    EXPECT_NEAR(vertex.norm(), kRadius_m, 0.005F * kRadius_m);
}

TEST(Decimated, leavesAMeshOfOnePointAlone)
{
  TriangleMesh mesh;
  mesh.vertices.assign(3, Eigen::Vector3f(5, 5, 5));
  mesh.triangles.assign(10, {0, 1, 2});
  EXPECT_EQ(decimated(mesh, 1).triangles, mesh.triangles);
}

TEST(Decimated, getsDownToTheLimitWithManyShells)
{
  std::vector<TriangleMesh> cubes;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 25; ++column)
      cubes.push_back(shifted(
          boxMesh({0.001F, 0.001F, 0.001F}),
          0.002F * Eigen::Vector3f(static_cast<float>(column), static_cast<float>(row), 0)));
  EXPECT_LE(decimated(joined(cubes), 2000).triangles.size(), 2000U);
}

TEST(SimplifiedMesh, leavesASmallMeshAlone)
{
  const TriangleMesh mesh = subdivided(angleMesh(), 4);
  ASSERT_LT(mesh.triangles.size(), 8000U);
  EXPECT_EQ(simplifiedMesh(mesh).triangles, mesh.triangles);
}

TEST(SimplifiedMesh, ofFlatFacesIsSmallAndClosed)
{
  for (const int times : {5, 6})
  {
    const TriangleMesh mesh = subdivided(angleMesh(), times);
    ASSERT_GT(mesh.triangles.size(), times == 5 ? 20000U : 80000U);
    const TriangleMesh simple = simplifiedMesh(mesh);
    EXPECT_LT(simple.triangles.size(), 3000U);
    EXPECT_TRUE(closedAndWoundAlike(simple));
    EXPECT_NEAR(volumeAndCenter(simple).first, volumeAndCenter(mesh).first,
                1e-3 * volumeAndCenter(mesh).first);
    expectTheSameShape(simple, mesh);
  }
}

/// A plate of 0.2 mm, and a fin without thickness on one of its edges, which four triangles share.
TEST(SimplifiedMesh, keepsThinWallsAndSharedEdges)
{
  TriangleMesh mesh = boxMesh({0.06F, 0.06F, 0.0002F});
  mesh.vertices.emplace_back(0.03F, 0.03F, 0.02F);
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  mesh.triangles.push_back({6, 7, top});
  mesh.triangles.push_back({7, 6, top});
  mesh = subdivided(mesh, 5);
  const TriangleMesh simple = simplifiedMesh(mesh);
  EXPECT_LE(simple.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(area(simple), area(mesh), 0.005 * area(mesh));
  expectTheSameShape(simple, mesh);
}

TEST(SimplifiedMesh, ofACurvedSurfaceStaysWithinTheTolerance)
{
  for (const int times : {5, 7})
  {
    TriangleMesh mesh = subdivided(boxMesh({1, 1, 1}), times);
    for (Eigen::Vector3f& vertex : mesh.vertices)
      vertex = kRadius_m * vertex.normalized();
    const TriangleMesh simple = simplifiedMesh(mesh);
    EXPECT_LE(simple.triangles.size(), 6750U);
    EXPECT_TRUE(closedAndWoundAlike(simple));
    expectTheSameShape(simple, mesh);
  }
}

TEST(SimplifiedMesh, keepsTheRimOfAnOpenSurface)
{
  const TriangleMesh mesh = subdivided(squareMesh(0.03F), 6);
  const TriangleMesh simple = simplifiedMesh(mesh);
  EXPECT_LT(simple.triangles.size(), 3000U);
  EXPECT_NEAR(area(simple), area(mesh), 0.002 * area(mesh));
  expectTheSameShape(simple, mesh);
}

TEST(SimplifiedMesh, leavesARoughSurfaceAsItIs)
{
  TriangleMesh mesh = subdivided(angleMesh(), 5);
  std::mt19937 rng(4);
  std::uniform_real_distribution<float> offset_m(-0.0005F, 0.0005F);
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex += Eigen::Vector3f(offset_m(rng), offset_m(rng), offset_m(rng));
  EXPECT_EQ(simplifiedMesh(mesh).triangles, mesh.triangles);
}
}  // namespace
}  // namespace ppf_bin_picking

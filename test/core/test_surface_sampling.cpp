#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "support/shapes.hpp"
#include "support/slow_ray_caster.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kSpacing_m = 0.001F;

/// The face of a box about the origin that a point lies on: axis, doubled, plus 1 for the positive
/// side.
std::size_t faceOf(const Eigen::Vector3f& point, const Eigen::Vector3f& size_m)
{
  Eigen::Index axis = 0;
  (point.cwiseAbs().array() / (0.5F * size_m.array())).maxCoeff(&axis);
  return static_cast<std::size_t>(2 * axis + (point(axis) > 0 ? 1 : 0));
}

/// Every second triangle wound the other way, at random.
TriangleMesh carelesslyWound(TriangleMesh mesh)
{
  std::mt19937 rng(9);
  for (auto& triangle : mesh.triangles)
    if (rng() % 2 == 0) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TEST(SampleVisibleSurface, givesEachFaceOfABoxItsShareOfTheSamples)
{
  const Eigen::Vector3f size_m(0.06F, 0.04F, 0.03F);
  TriangleMesh mesh = boxMesh(size_m);
  const OrientedPoints cloud = sampleVisibleSurface(mesh, kSpacing_m);
  std::array<int, 6> of_face{};
  std::array<int, 4> of_quarter{};  // of the upper face
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Eigen::Vector3f& p = cloud.points[i];
    const std::size_t face = faceOf(p, size_m);
    const auto axis = static_cast<Eigen::Index>(face / 2);
    ++of_face[face];
    if (face == 5) ++of_quarter[(p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U)];
    EXPECT_NEAR(std::abs(p(axis)), size_m(axis) / 2, 1e-7);
    EXPECT_TRUE((p.cwiseAbs().array() <= size_m.array() / 2 + 1e-7F).all());
    EXPECT_FLOAT_EQ(cloud.normals[i](axis), face % 2 == 1 ? 1.0F : -1.0F);
  }
  constexpr std::array<int, 6> kExpected{1200, 1200, 1800, 1800, 2400, 2400};  // mm^2
  for (std::size_t face = 0; face < 6; ++face)
    EXPECT_NEAR(of_face[face], kExpected[face], 2);
  for (const int count : of_quarter)
    EXPECT_NEAR(count, 600, 15);
}

TEST(SampleVisibleSurface, laysSamplesOutEvenlyOverTrianglesLargeAndSmall)
{
  constexpr float kRadius_m = 0.03F;
  TriangleMesh sphere = sphereMesh(kRadius_m);  // most triangles are smaller than a sample's share
  const OrientedPoints fine = sampleVisibleSurface(sphere, 0.002F);
  const double expected = 4 * M_PI * kRadius_m * kRadius_m / (0.002 * 0.002);
  EXPECT_NEAR(static_cast<double>(fine.size()), expected, 0.01 * expected);
  std::array<int, 8> of_octant{};
  for (std::size_t i = 0; i < fine.size(); ++i)
  {
    const Eigen::Vector3f& p = fine.points[i];
    ++of_octant[(p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U) + (p.z() > 0 ? 4U : 0U)];
    EXPECT_NEAR(p.norm(), kRadius_m, kRadius_m / 1600);
    EXPECT_GT(fine.normals[i].dot(p.normalized()), 0.999F);
  }
  for (const int count : of_octant)
    EXPECT_NEAR(count, expected / 8, 0.03 * expected / 8);

  TriangleMesh square = squareMesh(0.015F);
  const OrientedPoints flat = sampleVisibleSurface(square, kSpacing_m);
  int crowded = 0, lonely = 0;
  for (const Eigen::Vector3f& p : flat.points)
  {
    const auto within = [&](float reach_m)
    {
      return std::count_if(flat.points.begin(), flat.points.end(),
                           [&](const Eigen::Vector3f& other)
                           { return (other - p).norm() < reach_m; });
    };
    crowded += within(0.25F * kSpacing_m) > 2 ? 1 : 0;  // itself, and its twin on the other side
    lonely += within(2 * kSpacing_m) < 4 ? 1 : 0;
  }
  EXPECT_LT(crowded, 0.02 * static_cast<double>(flat.size()));
  EXPECT_EQ(lonely, 0);
}

TEST(SampleVisibleSurface, turnsNormalsOutwardsWhateverTheWindingSays)
{
  for (const TriangleMesh& wound :
       {angleMesh(), insideOut(angleMesh()), carelesslyWound(angleMesh())})
  {
    TriangleMesh mesh = wound;
    const OrientedPoints cloud = sampleVisibleSurface(mesh, 0.0015F);
    ASSERT_GT(cloud.size(), 1000U);
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      const Eigen::Vector3d p = cloud.points[i].cast<double>();
      const Eigen::Vector3d step = 1e-5 * cloud.normals[i].cast<double>();
      EXPECT_NEAR(cloud.normals[i].norm(), 1, 1e-5);
      ASSERT_FALSE(slowIsInside(angleMesh(), p + step)) << p.transpose();
      ASSERT_TRUE(slowIsInside(angleMesh(), p - step)) << p.transpose();
    }
    EXPECT_EQ(mesh.vertices, wound.vertices);
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const Eigen::Vector3f normal = (mesh.vertices[b] - mesh.vertices[a])
                                         .cross(mesh.vertices[c] - mesh.vertices[a])
                                         .normalized();
      const Eigen::Vector3f middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
      EXPECT_FALSE(slowIsInside(angleMesh(), (middle + 1e-5F * normal).cast<double>()));
    }
  }
}

TEST(SampleVisibleSurface, leavesOutWhatLiesInside)
{
  TriangleMesh nested = joined({boxMesh({0.06F, 0.05F, 0.04F}), boxMesh({0.03F, 0.03F, 0.02F}),
                                shifted(sphereMesh(0.005F), {0.02F, 0, 0})});
  const OrientedPoints cloud = sampleVisibleSurface(nested, kSpacing_m);
  EXPECT_NEAR(static_cast<double>(cloud.size()), 2 * (3000 + 2400 + 2000), 10);
  for (const Eigen::Vector3f& p : cloud.points)
    ASSERT_GT((p.cwiseAbs() - Eigen::Vector3f(0.03F, 0.025F, 0.02F)).maxCoeff(), -1e-6F);
}

TEST(SampleVisibleSurface, leavesOutWhereTwoBodiesOfAMeshTouch)
{
  TriangleMesh mesh = bracketMesh();  // its wall and its block stand on the plate
  const OrientedPoints cloud = sampleVisibleSurface(mesh, kSpacing_m);
  int under_wall = 0, on_plate = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Eigen::Vector3f& p = cloud.points[i];
    if (std::abs(p.z() - 0.008F) > 1e-5F) continue;
    const bool wall = std::abs(p.x() + 0.031F) < 0.002F && std::abs(p.y()) < 0.018F;
    under_wall += wall ? 1 : 0;
    on_plate += p.x() > -0.02F && std::abs(cloud.normals[i].z() - 1) < 1e-5F ? 1 : 0;
  }
  EXPECT_EQ(under_wall, 0);
  EXPECT_NEAR(on_plate, 55 * 40 - 20 * 12, 80);
}

TEST(SampleVisibleSurface, takesBothSidesOfSheets)
{
  TriangleMesh square = squareMesh(0.02F);
  const OrientedPoints sheet = sampleVisibleSurface(square, kSpacing_m);
  EXPECT_NEAR(static_cast<double>(sheet.size()), 2 * 1600, 8);
  const auto up = std::count_if(sheet.normals.begin(), sheet.normals.end(),
                                [](const Eigen::Vector3f& n) { return n.z() > 0.999F; });
  EXPECT_EQ(2 * static_cast<std::size_t>(up), sheet.size());

  TriangleMesh tray = boxMesh({0.05F, 0.04F, 0.005F});
  tray.triangles.erase(tray.triangles.begin() + 2, tray.triangles.begin() + 4);  // without +z
  const OrientedPoints open = sampleVisibleSurface(tray, kSpacing_m);
  std::array<int, 2> floor{};  // from outside and from within
  for (std::size_t i = 0; i < open.size(); ++i)
    if (std::abs(open.points[i].z() + 0.0025F) < 1e-6F) ++floor[open.normals[i].z() > 0 ? 1 : 0];
  EXPECT_NEAR(floor[0], 2000, 4);
  EXPECT_NEAR(floor[1], 2000, 20);
}

TEST(SampleVisibleSurface, givesNoNormalsInwardsBecauseAMeshHasACrack)
{
  const Eigen::Vector3f size_m(0.06F, 0.04F, 0.03F);
  TriangleMesh cracked = boxMesh(size_m);
  cracked.vertices.push_back(cracked.vertices[0]);  // written twice, so that an edge is open
  cracked.triangles[0][0] = static_cast<std::uint32_t>(cracked.vertices.size() - 1);
  const OrientedPoints cloud = sampleVisibleSurface(cracked, kSpacing_m);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_GT(cloud.normals[i].dot(cloud.points[i]), 0);
}

/// Random points whose normals point along an axis, about.
OrientedPoints randomCloud(std::uint32_t seed)
{
  std::mt19937 rng(seed);
  OrientedPoints cloud;
  for (int i = 0; i < 3000; ++i)
  {
    const Eigen::Vector3f axis = Eigen::Vector3f::Unit(static_cast<Eigen::Index>(rng() % 3)) *
                                 (rng() % 2 == 0 ? 1.0F : -1.0F);
    cloud.add(randomPoint(rng, 0.03F), (axis + 0.1F * randomDirection(rng)).normalized());
  }
  return cloud;
}

TEST(ThinOut, leavesTheMeanOfEachCellAndDirection)
{
  constexpr float kCell_m = 0.007F;
  const OrientedPoints cloud = randomCloud(2);
  struct Sum
  {
    Eigen::Vector3d points = Eigen::Vector3d::Zero(), normals = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::map<std::array<int, 4>, Sum> sums;  // by cell and axis
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    std::array<int, 4> key{};
    for (int k = 0; k < 3; ++k)
      key[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(cloud.points[i](k) / kCell_m));
    key[3] = static_cast<int>(faceOf(cloud.normals[i], Eigen::Vector3f::Ones()));
    Sum& sum = sums[key];
    sum.points += cloud.points[i].cast<double>();
    sum.normals += cloud.normals[i].cast<double>();
    ++sum.count;
  }
  const OrientedPoints thin = thinOut(cloud, kCell_m);
  ASSERT_EQ(thin.size(), sums.size());
  ASSERT_LT(thin.size(), cloud.size());
  for (std::size_t i = 0; i < thin.size(); ++i)
  {
    const bool known = std::any_of(
        sums.begin(), sums.end(),
        [&](const auto& entry)
        {
          const Sum& sum = entry.second;
          return (sum.points / sum.count - thin.points[i].cast<double>()).norm() < 1e-7 &&
                 (sum.normals.normalized() - thin.normals[i].cast<double>()).norm() < 1e-5;
        });
    EXPECT_TRUE(known) << thin.points[i].transpose();
  }
}

TEST(ThinOut, keepsTheTwoSidesOfAThinSheetApart)
{
  OrientedPoints sheet;
  for (int i = 0; i < 100; ++i)
  {
    const float x = 0.0005F * static_cast<float>(i);
    sheet.add({x, 0.001F, 0.002F}, {0, 0, 1});
    sheet.add({x, 0.001F, 0.001F}, {0, 0, -1});
  }
  const OrientedPoints thin = thinOut(sheet, 0.01F);
  ASSERT_EQ(thin.size(), 10U);
  for (std::size_t i = 0; i < thin.size(); ++i)
    EXPECT_NEAR(thin.points[i].z(), thin.normals[i].z() > 0 ? 0.002F : 0.001F, 1e-6);
}

TEST(ThinOut, doesNotDependOnTheOrderWhereDirectionsAreDistinct)
{
  const OrientedPoints cloud = randomCloud(6);
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(8));
  OrientedPoints shuffled;
  for (const std::size_t i : order)
    shuffled.add(cloud.points[i], cloud.normals[i]);
  const OrientedPoints a = thinOut(cloud, 0.007F), b = thinOut(shuffled, 0.007F);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    float nearest = 1;
    for (std::size_t k = 0; k < b.size(); ++k)
      nearest = std::min(nearest, (a.points[i] - b.points[k]).norm() +
                                      0.01F * (a.normals[i] - b.normals[k]).norm());
    EXPECT_LT(nearest, 1e-6F);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/ros/simplified_mesh.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::TriangleMesh;

/// A sphere of 1 m about the origin; 2 * rings * sectors triangles.
TriangleMesh sphere(const std::uint32_t rings, const std::uint32_t sectors)
{
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring)
    for (std::uint32_t sector = 0; sector < sectors; ++sector)
    {
      const double polar = M_PI * ring / rings;
      const double around = 2 * M_PI * sector / sectors;
      mesh.vertices.push_back(Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                              std::sin(polar) * std::sin(around), std::cos(polar))
                                  .cast<float>());
    }
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t sector = 0; sector < sectors; ++sector)
    {
      const std::uint32_t next = (sector + 1) % sectors;
      const std::uint32_t a = ring * sectors + sector, b = ring * sectors + next;
      mesh.triangles.push_back({a, a + sectors, b});
      mesh.triangles.push_back({b, a + sectors, b + sectors});
    }
  return mesh;
}

double area(const TriangleMesh& mesh)
{
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                     .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                     .norm();
  return sum;
}

TEST(SimplifiedMesh, leavesASmallMeshAlone)
{
  const TriangleMesh mesh = sphere(10, 20);
  const TriangleMesh same = simplifiedMesh(mesh, mesh.triangles.size());
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(same.vertices.size(), mesh.vertices.size());
}

TEST(SimplifiedMesh, keepsTheShapeOfALargeOne)
{
  const TriangleMesh mesh = sphere(200, 400);
  const TriangleMesh simple = simplifiedMesh(mesh, 2000);
  EXPECT_LE(simple.triangles.size(), 2000U);
  EXPECT_GT(simple.triangles.size(), 700U);
  EXPECT_NEAR(area(simple), area(mesh), 0.05 * area(mesh));
  for (const Eigen::Vector3f& vertex : simple.vertices)
    EXPECT_NEAR(vertex.norm(), 1.0F, 1e-5F);
}

TEST(SimplifiedMesh, endsForAMeshOfOnePoint)
{
  TriangleMesh mesh;
  mesh.vertices.assign(3, Eigen::Vector3f(5, 5, 5));
  mesh.triangles.assign(10, {0, 1, 2});
  EXPECT_LE(simplifiedMesh(mesh, 1).triangles.size(), 1U);
}
}  // namespace
}  // namespace ppf_bin_picking_ros

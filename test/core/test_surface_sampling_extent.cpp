#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>

namespace ppf_bin_picking
{
namespace
{
/// The largest distance between two of many vertices [m].
float slowDiameter(const TriangleMesh& mesh)
{
  float largest = 0;
  for (const Eigen::Vector3f& a : mesh.vertices)
    for (const Eigen::Vector3f& b : mesh.vertices)
      largest = std::max(largest, (a - b).norm());
  return largest;
}

TEST(MeshDiameter, isTheLargestDistanceOfTwoVertices)
{
  std::mt19937 rng(4);
  for (const std::size_t vertices : {0U, 1U, 2U, 50U, 1500U, 4000U})
    for (const float flatness : {1.0F, 0.3F, 0.02F})
    {
      SCOPED_TRACE(::testing::Message() << vertices << " " << flatness);
      TriangleMesh mesh;
      for (std::size_t i = 0; i < vertices; ++i)
        mesh.vertices.push_back(
            randomDirection(rng).cwiseProduct(Eigen::Vector3f(0.05F, 0.05F * flatness, 0.04F)) +
            Eigen::Vector3f(1, 2, 3));
      const float expected = slowDiameter(mesh);
      EXPECT_LE(meshDiameter(mesh), expected + 1e-6F);
      EXPECT_GE(meshDiameter(mesh), expected * (vertices > 2000 ? 0.9995F : 0.999999F));
    }
}

TEST(BoundingSphereCenter, isWithinAPerMilleOfTheSmallestSphere)
{
  struct Case
  {
    TriangleMesh mesh;
    Eigen::Vector3f center;
  };
  const Eigen::Vector3f place(0.3F, -0.2F, 0.5F);
  TriangleMesh obtuse;  // its longest side is the sphere's diameter
  obtuse.vertices = {{0, 0, 0}, {0.1F, 0, 0}, {0.04F, 0.01F, 0}};
  TriangleMesh lopsided = sphereMesh(0.05F);  // many vertices on one side do not pull the centre
  for (int i = 0; i < 5000; ++i)
    lopsided.vertices.emplace_back(0.03F, 1e-6F * static_cast<float>(i), 0);
  for (const Case& one :
       {Case{boxMesh({0.06F, 0.04F, 0.03F}), {0, 0, 0}}, Case{sphereMesh(0.05F), {0, 0, 0}},
        Case{obtuse, {0.05F, 0, 0}}, Case{lopsided, {0, 0, 0}}})
  {
    const TriangleMesh mesh = shifted(one.mesh, place);
    const Eigen::Vector3f found = boundingSphereCenter(mesh);
    float smallest = 0, largest = 0;
    for (const Eigen::Vector3f& vertex : mesh.vertices)
    {
      smallest = std::max(smallest, (vertex - one.center - place).norm());
      largest = std::max(largest, (vertex - found).norm());
    }
    EXPECT_LE(largest, 1.001F * smallest + 1e-6F);
    EXPECT_LE((found - one.center - place).norm(), 0.05F * smallest);
  }
  EXPECT_EQ(boundingSphereCenter(TriangleMesh()), Eigen::Vector3f::Zero());
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/symmetry_check.hpp"
#include "ppf_bin_picking/core/symmetry_search.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
TriangleMesh moved(TriangleMesh mesh, const Eigen::Isometry3d& motion)
{
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = motion.cast<float>() * vertex;
  return mesh;
}

/// A plain pin along z, 12 across and 60 mm long.
TriangleMesh pin()
{
  return cylinderMesh(0.006F, 0.06F, 32);
}

std::size_t turnsOf(const TriangleMesh& mesh)
{
  const SymmetryGroup found = findSymmetries(mesh);
  EXPECT_FALSE(found.revolution()) << describe(found, 0.001);
  return found.motions().size();
}

TEST(FoundSymmetries, areThoseOfABox)
{
  EXPECT_EQ(turnsOf(boxMesh({0.06F, 0.04F, 0.02F})), 4U);
  EXPECT_EQ(turnsOf(boxMesh({0.04F, 0.04F, 0.02F})), 8U);
  EXPECT_EQ(turnsOf(boxMesh({0.04F, 0.04F, 0.04F})), 24U);
}

TEST(FoundSymmetries, areThoseOfAPrism)
{
  EXPECT_EQ(turnsOf(cylinderMesh(0.02F, 0.03F, 3)), 6U);
  EXPECT_EQ(turnsOf(cylinderMesh(0.02F, 0.01F, 5)), 10U);
  EXPECT_EQ(turnsOf(cylinderMesh(0.02F, 0.015F, 6)), 12U);
}

TEST(FoundSymmetries, areThoseOfATetrahedron)
{
  TriangleMesh mesh;
  mesh.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  EXPECT_EQ(turnsOf(mesh), 12U);
}

TEST(FoundSymmetries, areNoneOfABracket)
{
  EXPECT_EQ(turnsOf(bracketMesh()), 1U);
}

TEST(FoundSymmetries, areARevolutionInSpiteOfFacets)
{
  const SymmetryGroup found = findSymmetries(pin());
  ASSERT_TRUE(found.revolution());
  EXPECT_FALSE(found.sphere());
  EXPECT_TRUE(found.revolution()->axis.isApprox(Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_TRUE(found.revolution()->point.isZero(1e-9));
  EXPECT_EQ(found.motions().size(), 2U);  // end for end
}

TEST(FoundSymmetries, areAllTurnsOfABall)
{
  const Eigen::Vector3f center(0.03F, -0.02F, 0.01F);
  const SymmetryGroup found = findSymmetries(shifted(sphereMesh(0.01F), center));
  ASSERT_TRUE(found.sphere());
  EXPECT_LT((meetingPoint(found.revolutionAxes()) - center.cast<double>()).norm(), 1e-4);
}

// What tells the two ends of a pin apart, or stops a revolution, is small.
TEST(FoundSymmetries, respectSmallFeatures)
{
  const SymmetryGroup headed =
      findSymmetries(joined({pin(), shifted(cylinderMesh(0.0075F, 0.003F, 32), {0, 0, 0.0285F})}));
  ASSERT_TRUE(headed.revolution());
  EXPECT_EQ(headed.motions().size(), 1U);
  // A key of 2 x 1 mm along 20 mm of the pin, off its middle.
  EXPECT_EQ(
      turnsOf(joined({pin(), shifted(boxMesh({0.002F, 0.002F, 0.02F}), {0, 0.006F, 0.015F})})), 1U);
  // A flat 1 mm deep along the whole pin: a half turn about the line across it stays.
  TriangleMesh flat = pin();
  for (Eigen::Vector3f& vertex : flat.vertices)
    vertex.y() = std::min(vertex.y(), 0.005F);
  EXPECT_EQ(turnsOf(flat), 2U);
}

// Six bosses on a disc, one of them a little farther out.
TEST(FoundSymmetries, respectTheOddBossOfAFlange)
{
  for (const float odd_m : {0.0F, 0.003F})
  {
    SCOPED_TRACE(odd_m);
    std::vector<TriangleMesh> parts = {cylinderMesh(0.04F, 0.008F, 96)};
    for (int k = 0; k < 6; ++k)
    {
      const float angle = static_cast<float>(k) * static_cast<float>(M_PI) / 3;
      const float out_m = 0.03F + (k == 2 ? odd_m : 0.0F);
      parts.push_back(shifted(cylinderMesh(0.004F, 0.008F, 24),
                              {out_m * std::cos(angle), out_m * std::sin(angle), 0.004F}));
    }
    EXPECT_EQ(turnsOf(joined(parts)), odd_m > 0 ? 1U : 6U);
  }
}

TEST(FoundSymmetries, moveWithTheMesh)
{
  std::mt19937 rng(11);  // fixed, so that a failure repeats
  std::normal_distribution<double> normal;
  const TriangleMesh meshes[] = {boxMesh({0.06F, 0.04F, 0.02F}), cylinderMesh(0.02F, 0.015F, 6),
                                 pin()};
  for (const TriangleMesh& mesh : meshes)
    for (int trial = 0; trial < 3; ++trial)
    {
      SCOPED_TRACE(trial);
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      motion.linear() = Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng))
                            .normalized()
                            .toRotationMatrix();
      motion.translation() = 0.05 * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
      const SymmetryGroup at_home = findSymmetries(mesh);
      const SymmetryGroup away = findSymmetries(moved(mesh, motion));
      ASSERT_EQ(away.motions().size(), at_home.motions().size());
      ASSERT_EQ(away.revolution().has_value(), at_home.revolution().has_value());
      if (!away.revolution()) continue;
      const Eigen::Vector3d axis = motion.linear() * at_home.revolution()->axis;
      EXPECT_GT(std::abs(away.revolution()->axis.dot(axis)), std::cos(0.002));
      const Eigen::Vector3d offset =
          away.revolution()->point - motion * at_home.revolution()->point;
      EXPECT_LT(offset.cross(axis).norm(), 1e-4);
    }
}

TEST(FoundSymmetries, needASurface)
{
  EXPECT_THROW(findSymmetries(TriangleMesh()), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking

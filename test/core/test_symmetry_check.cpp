#include "ppf_bin_picking/core/symmetry_check.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace ppf_bin_picking
{
namespace
{
/// A plain pin along z, 12 across and 60 mm long.
TriangleMesh pin()
{
  return cylinderMesh(0.006F, 0.06F, 32);
}

TEST(StatedSymmetries, passIfTheMeshHasThem)
{
  EXPECT_EQ(symmetryProblem(bracketMesh(), {}), "");
  const SymmetryAxis z;
  EXPECT_EQ(symmetryProblem(pin(), {{}, {z}}), "");
  EXPECT_EQ(symmetryProblem(boxMesh({0.06F, 0.04F, 0.02F}), {{{z, M_PI}}, {}}), "");
}

TEST(StatedSymmetries, areRefusedByNameIfTheMeshHasThemNot)
{
  const SymmetryAxis z, aside{Eigen::Vector3d::UnitZ(), {0.004, 0, 0}};
  const TriangleMesh box = boxMesh({0.06F, 0.04F, 0.02F});
  const std::string quarter = symmetryProblem(box, {{{z, M_PI / 2}}, {}});
  EXPECT_NE(quarter.find("1/4 turn about the axis [0, 0, 1] through [0, 0, 0] mm"),
            std::string::npos)
      << quarter;
  EXPECT_NE(quarter.find("moves by 10.00 mm, more than 1.50 mm"), std::string::npos) << quarter;
  const std::string shifted_half = symmetryProblem(box, {{{aside, M_PI}}, {}});
  EXPECT_NE(shifted_half.find("through [4, 0, 0] mm"), std::string::npos) << shifted_half;
  EXPECT_NE(symmetryProblem(box, {{}, {z}}).find("the revolution about"), std::string::npos);
}

TEST(UnstatedSymmetries, areThoseThatTheStatedOnesDoNotBringAlong)
{
  const auto about = [](const Eigen::Vector3d& axis, double angle_rad) {
    return DiscreteSymmetry{{axis, Eigen::Vector3d::Zero()}, angle_rad};
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  const SymmetryGroup nut({about(z, M_PI / 3), about(x, M_PI)}, {});
  EXPECT_EQ(unstatedSymmetries(nut, nut, 1), "");
  EXPECT_EQ(unstatedSymmetries({}, nut, 1), describe(nut, 1));
  EXPECT_EQ(unstatedSymmetries(SymmetryGroup({about(z, M_PI / 3)}, {}), nut, 1),
            "1/2 turn about [1, 0, 0] through [0, 0, 0]");
  EXPECT_EQ(unstatedSymmetries(SymmetryGroup({about(z, 2 * M_PI / 3), about(z, M_PI),
                                              about({0.5, std::sqrt(0.75), 0}, M_PI)},
                                             {}),
                               nut, 1),
            "");  // other generators of the same turns
  const SymmetryGroup shaft({about(x, M_PI)}, {SymmetryAxis()});
  EXPECT_EQ(unstatedSymmetries(shaft, shaft, 1), "");
  EXPECT_EQ(unstatedSymmetries(SymmetryGroup({about(z, M_PI / 2), about(x, M_PI)}, {}), shaft, 1),
            "every turn about [0, 0, 1] through [0, 0, 0]");
  const SymmetryGroup ball({}, {SymmetryAxis(), {x, Eigen::Vector3d::Zero()}});
  EXPECT_EQ(unstatedSymmetries(ball, ball, 1), "");
  EXPECT_EQ(unstatedSymmetries(ball, shaft, 1), "");
  EXPECT_NE(unstatedSymmetries(shaft, ball, 1), "");
}

TEST(Describe, namesEveryGenerator)
{
  EXPECT_EQ(describe({}, 1), "none");
  const SymmetryGroup nut({{{Eigen::Vector3d::UnitZ(), {0.002, 0, 0}}, M_PI / 3}}, {});
  EXPECT_EQ(describe(nut, 0.001), "1/6 turn about [0, 0, 1] through [2, 0, 0]");
  EXPECT_EQ(describe({{}, {SymmetryAxis()}}, 1), "every turn about [0, 0, 1] through [0, 0, 0]");
}
}  // namespace
}  // namespace ppf_bin_picking

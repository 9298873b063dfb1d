// The parts of the package's own: each file of config/parts with its mesh.
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/symmetry_check.hpp"
#include "ppf_bin_picking/core/symmetry_search.hpp"

#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"

#include "support/mesh_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace ppf_bin_picking
{
namespace
{
constexpr double kFacet_m = 0.00005;      // facets of a round lie so far off the round at most
constexpr double kJaws_m = 0.050;         // a gripper's stroke
constexpr double kFingerGap_m = 0.002;    // between a finger and what it is about to grip
constexpr double kFingerThick_m = 0.006;  // along the stroke
constexpr double kFingerWide_m = 0.008;   // across it

std::vector<std::string> shippedParts()
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(PACKAGE_FOLDER "/config/parts"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedPart : public testing::TestWithParam<std::string>
{
protected:
  ShippedPart()
      : part_(loadPart(PACKAGE_FOLDER "/config/parts/" + GetParam() + ".yaml")),
        loaded_(loadMesh(part_.mesh_file, part_.unit))
  {
  }

  /// Whether the surface, moved, is anywhere farther from itself.
  bool differs(const Eigen::Isometry3d& motion, double distance_m) const
  {
    const std::vector<Eigen::Vector3d> points = spreadPoints(mesh_, 400);
    return std::any_of(points.begin(), points.end(),
                       [&](const Eigen::Vector3d& point)
                       { return surfaceDistance(mesh_, motion * point) > distance_m; });
  }

  static Eigen::Isometry3d turn(const Eigen::Vector3d& axis, const Eigen::Vector3d& point,
                                double angle_rad)
  {
    return Eigen::Translation3d(point) * Eigen::AngleAxisd(angle_rad, axis.normalized()) *
           Eigen::Translation3d(-point);
  }

  PartDescription part_;
  LoadedMesh loaded_;
  const TriangleMesh& mesh_ = loaded_.mesh;
};

TEST_P(ShippedPart, hasASmallWholeMeshOfARealPartsSize)
{
  EXPECT_EQ(std::filesystem::path(part_.mesh_file).stem(), GetParam());
  EXPECT_TRUE(loaded_.warnings.empty()) << loaded_.warnings.front();
  const bool free_form = GetParam() == "bracket" || GetParam() == "tee";
  EXPECT_LE(std::filesystem::file_size(part_.mesh_file), free_form ? 360000U : 100000U);
  EXPECT_TRUE(closedAndWoundAlike(mesh_));
  EXPECT_GT(volumeAndCenter(mesh_).first, 1e-6);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh_.vertices)
    box.extend(vertex);
  EXPECT_GT(box.sizes().maxCoeff(), 0.020F);
  EXPECT_LT(box.sizes().maxCoeff(), 0.120F);
}

TEST_P(ShippedPart, isMappedOntoItselfByItsSymmetries)
{
  for (const DiscreteSymmetry& symmetry : part_.symmetries_discrete)
    EXPECT_FALSE(
        differs(turn(symmetry.line.axis, symmetry.line.point, symmetry.angle_rad), kFacet_m));
  for (const SymmetryAxis& line : part_.symmetries_continuous)
    for (const double angle_rad : {0.3, 1.0, 2.9})
      EXPECT_FALSE(differs(turn(line.axis, line.point, angle_rad), kFacet_m)) << angle_rad;
}

// A turn that maps the part onto itself keeps its centre of mass; those tried are about axes that
// a symmetric part of this folder would have.
TEST_P(ShippedPart, hasNoSymmetryThatItsFileDoesNotName)
{
  const Eigen::Vector3d center = volumeAndCenter(mesh_).second;
  const SymmetryGroup symmetries = part_.symmetries();
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, -1, 0), Eigen::Vector3d(1, 0, 1),
        Eigen::Vector3d(-1, 0, 1), Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(0, 1, -1)})
    for (const int parts_of_a_turn : {2, 3, 4, 5, 32})
    {
      const Eigen::Isometry3d motion = turn(axis, center, 2 * M_PI / parts_of_a_turn);
      const Eigen::Quaternionf rotation(motion.linear().cast<float>());
      if (symmetries.rotationDistance(Eigen::Quaternionf::Identity(), rotation) < 1e-3) continue;
      EXPECT_TRUE(differs(motion, 10 * kFacet_m))
          << "1/" << parts_of_a_turn << " turn about " << axis.transpose();
    }
}

TEST_P(ShippedPart, hasTheSymmetriesThatItsMeshShows)
{
  const SymmetryGroup stated = part_.symmetries(), found = findSymmetries(mesh_);
  EXPECT_EQ(symmetryProblem(mesh_, stated), "");
  EXPECT_EQ(found.sphere(), stated.sphere());
  EXPECT_EQ(found.revolution().has_value(), stated.revolution().has_value());
  ASSERT_EQ(found.motions().size(), stated.motions().size()) << describe(found, 0.001);
  for (const Eigen::Isometry3d& motion : found.motions())
    EXPECT_LT(stated.rotationDistance(Eigen::Quaternionf::Identity(),
                                      Eigen::Quaternionf(motion.linear().cast<float>())),
              0.002);
}

TEST_P(ShippedPart, isGrippedByItsPicks)
{
  std::set<std::string> names;
  for (const Pick& pick : part_.picks)
  {
    SCOPED_TRACE(pick.name);
    EXPECT_TRUE(names.insert(pick.name).second);
    const Eigen::Matrix3d rotation = pick.T_model_pick.linear();
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-9));
    EXPECT_NEAR(rotation.determinant(), 1, 1e-9);

    // The jaws close on two faces opposite each other, the gripper's tip between them.
    const Eigen::Vector3d tip = pick.T_model_pick.translation();
    std::vector<LineHit> hits = lineHits(mesh_, tip, rotation.col(0));
    ASSERT_GE(hits.size(), 2U);
    const auto [low, high] = std::minmax_element(hits.begin(), hits.end(),
                                                 [](const LineHit& a, const LineHit& b)
                                                 { return a.along_m < b.along_m; });
    EXPECT_LT(low->along_m, 0);
    EXPECT_GT(high->along_m, 0);
    EXPECT_NEAR(low->along_m, -high->along_m, 0.001);
    EXPECT_LT(high->along_m - low->along_m, kJaws_m - 2 * kFingerGap_m);
    EXPECT_GT(high->normal.dot(rotation.col(0)), 0.95);
    EXPECT_LT(low->normal.dot(rotation.col(0)), -0.95);

    // Nothing of the part is in the way of the open fingers.
    for (const double reach_m :
         {low->along_m - kFingerGap_m, low->along_m - kFingerGap_m - kFingerThick_m,
          high->along_m + kFingerGap_m, high->along_m + kFingerGap_m + kFingerThick_m})
      for (const double aside_m : {-kFingerWide_m / 2, 0.0, kFingerWide_m / 2})
        for (const LineHit& hit : lineHits(
                 mesh_, pick.T_model_pick * Eigen::Vector3d(reach_m, aside_m, 0), -rotation.col(2)))
          EXPECT_LT(hit.along_m, 0) << "finger at " << reach_m << ", " << aside_m;
  }
}

// Whichever way the part lies, one of the picks comes from above or leans by 55 degrees at most
// (54.7: six picks at right angles, the part on its corner).
TEST_P(ShippedPart, canBePickedFromEverySide)
{
  constexpr int kDirections = 500;
  for (int i = 0; i < kDirections; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / kDirections;
    const double turn_rad = i * M_PI * (3 - std::sqrt(5));
    const double across = std::sqrt(1 - z * z);
    const Eigen::Vector3d up(across * std::cos(turn_rad), across * std::sin(turn_rad), z);
    double best = -1;
    for (const Pick& pick : part_.picks)
      best = std::max(best, -up.dot(pick.T_model_pick.linear().col(2)));
    EXPECT_GT(best, std::cos(55 * M_PI / 180)) << "up is " << up.transpose();
  }
}

TEST_P(ShippedPart, trains)
{
  const PpfModel model =
      PpfModel::train(mesh_, part_.symmetries(), part_.adapted(DetectorConfig()).model);
  EXPECT_GT(model.data().points.size(), 100U);
  EXPECT_FALSE(model.data().entries.empty());
}

TEST(ShippedParts, areAtLeastTwelve)
{
  EXPECT_GE(shippedParts().size(), 12U);
}

INSTANTIATE_TEST_SUITE_P(Each, ShippedPart, testing::ValuesIn(shippedParts()),
                         [](const auto& info) { return info.param; });
}  // namespace
}  // namespace ppf_bin_picking

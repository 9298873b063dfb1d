#include "ppf_bin_picking/core/canonical_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
const SymmetryAxis kZ;
const SymmetryAxis kX{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()};
const SymmetryAxis kAside{Eigen::Vector3d(1, 0, -1).normalized(), {0.02, 0.01, 0.005}};

class CanonicalPose : public testing::Test
{
protected:
  Eigen::Isometry3d randomPose()
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond(normal_(rng_), normal_(rng_), normal_(rng_), normal_(rng_))
                        .normalized()
                        .toRotationMatrix();
    pose.translation() = Eigen::Vector3d(normal_(rng_), normal_(rng_), normal_(rng_));
    return pose;
  }

  /// A random symmetry.
  Eigen::Isometry3d randomMotion(const SymmetryGroup& group)
  {
    Eigen::Isometry3d motion = group.motions()[rng_() % group.motions().size()];
    for (const SymmetryAxis& line : group.revolutionAxes())
      motion = motion * turnAbout(line, 3 * normal_(rng_));
    return motion;
  }

  std::vector<SymmetryGroup> groups_ = {
      SymmetryGroup(),
      SymmetryGroup({{kZ, M_PI}}, {}),
      SymmetryGroup({{kAside, M_PI}}, {}),
      SymmetryGroup({{kZ, M_PI / 3}, {kX, M_PI}}, {}),
      SymmetryGroup({{kZ, M_PI / 2}, {kX, M_PI / 2}}, {}),
      SymmetryGroup({}, {kZ}),
      SymmetryGroup({}, {kAside}),
      SymmetryGroup({{kX, M_PI}}, {kZ}),
      SymmetryGroup({}, {{kZ.axis, {0.01, 0.02, 0}}, {kX.axis, {0, 0.02, 0.03}}})};
  std::mt19937 rng_{17};  // fixed, so that a failure repeats
  std::normal_distribution<double> normal_;
};

TEST_F(CanonicalPose, isTheSameForAllPosesOfAnOrbit)
{
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int trial = 0; trial < 300; ++trial)
    {
      SCOPED_TRACE("group " + std::to_string(g) + " trial " + std::to_string(trial));
      const Eigen::Isometry3d pose = randomPose();
      const Eigen::Isometry3d canonical = canonicalPose(pose, groups_[g]);
      EXPECT_TRUE(
          canonicalPose(pose * randomMotion(groups_[g]), groups_[g]).isApprox(canonical, 1e-6));
      EXPECT_TRUE(canonicalPose(canonical, groups_[g]).isApprox(canonical, 1e-9));
    }
}

TEST_F(CanonicalPose, isOneOfItsOrbit)
{
  for (const SymmetryGroup& group : groups_)
    for (int trial = 0; trial < 50; ++trial)
    {
      SCOPED_TRACE(trial);
      const Eigen::Isometry3d pose = randomPose();
      const Eigen::Isometry3d moved = pose.inverse() * canonicalPose(pose, group);
      if (group.sphere())
      {
        EXPECT_LT((moved * group.sphereCenter() - group.sphereCenter()).norm(), 1e-9);
        continue;
      }
      double nearest = 1;
      for (const Eigen::Isometry3d& motion : group.motions())
      {
        const Eigen::Isometry3d rest = motion.inverse() * moved;
        if (!group.revolution())
          nearest = std::min(nearest, (rest.matrix() - Eigen::Matrix4d::Identity()).norm());
        else
          nearest = std::min(
              nearest,
              (rest.linear() * group.revolution()->axis - group.revolution()->axis).norm() +
                  (rest * group.revolution()->point - group.revolution()->point).norm());
      }
      EXPECT_LT(nearest, 1e-9);
    }
}

// A random pose is no tie, and a small motion hardly ever leads across one.
TEST_F(CanonicalPose, changesSteadily)
{
  constexpr int kTrials = 300;
  for (std::size_t g = 0; g < groups_.size(); ++g)
  {
    int jumps = 0;
    for (int trial = 0; trial < kTrials; ++trial)
    {
      const Eigen::Isometry3d pose = randomPose();
      Eigen::Isometry3d near = pose;
      near.prerotate(Eigen::AngleAxisd(1e-5, Eigen::Vector3d(1, 2, 3).normalized()));
      const Eigen::Isometry3d change =
          canonicalPose(pose, groups_[g]).inverse() * canonicalPose(near, groups_[g]);
      if (Eigen::AngleAxisd(change.linear()).angle() > 1e-3) ++jumps;
    }
    EXPECT_LE(jumps, 1) << "group " << g;
  }
}

// As parts lie: an axis up, down or level is no tie, so that noise does not turn the pose.
TEST_F(CanonicalPose, isSteadyWhereAPartLiesFlat)
{
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
    for (const SymmetryGroup& group :
         {SymmetryGroup({}, {kZ}), SymmetryGroup({}, {kX}), SymmetryGroup({{kZ, M_PI}}, {})})
      for (const double turn_rad : {0.0, M_PI / 2, M_PI, -M_PI / 2})
      {
        const Eigen::Isometry3d pose = turnAbout({axis, Eigen::Vector3d::Zero()}, turn_rad);
        Eigen::Isometry3d near = pose;
        near.prerotate(Eigen::AngleAxisd(1e-3, Eigen::Vector3d(1, -2, 3).normalized()));
        const Eigen::Isometry3d change =
            canonicalPose(pose, group).inverse() * canonicalPose(near, group);
        EXPECT_LT(Eigen::AngleAxisd(change.linear()).angle(), 0.02);
      }
}

// All turns about the axis are equally far from the reference there.
TEST_F(CanonicalPose, isOneEvenWhereTheAxisPointsAwayFromItsReference)
{
  const SymmetryGroup pin({}, {kZ});
  const Eigen::AngleAxisd reference(M_PI / 3, Eigen::Vector3d(1, 2, 3).normalized());
  const Eigen::Vector3d away = -(reference * Eigen::Vector3d::UnitZ());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), away).toRotationMatrix();
  const Eigen::Isometry3d canonical = canonicalPose(pose, pin);
  for (const double turn_rad : {0.3, 1.7, -2.2})
    EXPECT_TRUE(canonicalPose(pose * turnAbout(kZ, turn_rad), pin).isApprox(canonical, 1e-6));
}
}  // namespace
}  // namespace ppf_bin_picking

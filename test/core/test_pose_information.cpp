#include "ppf_bin_picking/core/pose_information.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNormalGate_m = 0.003F;

float holdIn(const RangeImage& image, const PpfModel& model, const Eigen::Isometry3d& pose)
{
  return gatherInformation(image, model, pose.cast<float>(), DetectorConfig())
      .hold(model, pose.cast<float>());
}

const TriangleMesh& plateMesh()
{
  static const TriangleMesh mesh = boxMesh({0.08F, 0.06F, 0.006F});
  return mesh;
}

TEST(PoseInformation, aFreePlateIsHeldAndOneWithinALargerFaceIsNot)
{
  const PpfModel plate = coarselyTrained(plateMesh());
  const Eigen::Isometry3d pose = poseOf(0, {1, 0, 0}, {0, 0, 0.6});
  const float free = holdIn(imageOf({wall(0.8), {plateMesh(), pose}}, kNormalGate_m), plate, pose);
  EXPECT_GT(free, 0.1F);
  EXPECT_LT(holdIn(imageOf({wall(0.597)}, kNormalGate_m), plate, pose), 0.01F * free);
}

TEST(PoseInformation, aPlateOnASlideIsHeldLess)
{
  const PpfModel plate = coarselyTrained(plateMesh());
  const Eigen::Isometry3d pose = poseOf(0, {1, 0, 0}, {0, 0, 0.6});
  const float free = holdIn(imageOf({wall(0.8), {plateMesh(), pose}}, kNormalGate_m), plate, pose);
  const TriangleMesh bar = boxMesh({0.3F, 0.06F, 0.006F});  // goes on beyond two of its sides
  EXPECT_LT(holdIn(imageOf({wall(0.8), {bar, pose}}, kNormalGate_m), plate, pose), 0.2F * free);
}

TEST(PoseInformation, whatTheSymmetriesHideNeedNotBeHeld)
{
  const TriangleMesh mesh = cylinderMesh(0.012F, 0.08F, 64);
  const SymmetryAxis axis{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  const Eigen::Isometry3d pose = poseOf(1.3, {1, 0.4, 0}, {0.01, 0, 0.6});
  const RangeImage image = imageOf({wall(0.8), {mesh, pose}}, kNormalGate_m);
  const float turning = holdIn(image, coarselyTrained(mesh), pose);
  EXPECT_LT(turning, 0.01F);
  EXPECT_GT(holdIn(image, coarselyTrained(mesh, SymmetryGroup({}, {axis})), pose), 0.02F);
  const SymmetryAxis other{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()};
  EXPECT_GT(holdIn(image, coarselyTrained(mesh, SymmetryGroup({}, {axis, other})), pose),
            holdIn(image, coarselyTrained(mesh, SymmetryGroup({}, {axis})), pose) - 1e-4F);
}

TEST(MotionJacobian, isTheChangeOfACoordinateWithASmallMotion)
{
  std::mt19937 rng(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Vector3d arm = randomPoint(rng, 1).cast<double>();
    const Eigen::Vector3d direction = randomDirection(rng).cast<double>();
    const Eigen::Vector3d turn = 1e-5 * randomPoint(rng, 1).cast<double>();
    const Eigen::Vector3d shift = 1e-5 * randomPoint(rng, 1).cast<double>();
    const Eigen::Vector3d moved = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * arm + shift;
    Eigen::Matrix<double, 6, 1> motion;
    motion << turn, shift;
    const double change =
        motionJacobian(arm.cast<float>(), direction.cast<float>()).cast<double>().dot(motion);
    EXPECT_NEAR(change, direction.dot(moved - arm), 1e-9);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

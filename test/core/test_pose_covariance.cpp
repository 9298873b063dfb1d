#include "ppf_bin_picking/core/pose_covariance.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
RangeImage noisyImage(const std::vector<PlacedMesh>& scene, float noise_m = 0.0002F)
{
  return imageOf(scene, 0.003F, noise_m, 9);
}

Matrix6d covarianceOf(const RangeImage& image, const PpfModel& model, const Eigen::Isometry3d& pose)
{
  return poseCovariance(image, model, pose, DetectorConfig());
}

const TriangleMesh& plateMesh()
{
  static const TriangleMesh mesh = boxMesh({0.08F, 0.06F, 0.006F});
  return mesh;
}

TEST(PoseCovariance, isSmallSymmetricAndPositive)
{
  const Eigen::Isometry3d pose = poseOf(0.5, {1, 0.4, 0}, {0.01, 0, 0.6});
  const RangeImage image = noisyImage({wall(0.8), {plateMesh(), pose}});
  const Matrix6d covariance = covarianceOf(image, coarselyTrained(plateMesh()), pose);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues()(0), 0);
  EXPECT_LT(std::sqrt(covariance.topLeftCorner<3, 3>().trace()), 0.002);
  EXPECT_LT(std::sqrt(covariance.bottomRightCorner<3, 3>().trace()), 0.05);
}

TEST(PoseCovariance, growsWithTheNoise)
{
  const Eigen::Isometry3d pose = poseOf(0.5, {1, 0.4, 0}, {0.01, 0, 0.6});
  const PpfModel plate = coarselyTrained(plateMesh());
  const Matrix6d quiet =
      covarianceOf(noisyImage({wall(0.8), {plateMesh(), pose}}, 0.0002F), plate, pose);
  const Matrix6d noisy =
      covarianceOf(noisyImage({wall(0.8), {plateMesh(), pose}}, 0.0006F), plate, pose);
  const Eigen::Vector3d normal = pose.linear().col(2);  // surfaces alone hold the plate along it
  const double before = normal.dot(quiet.topLeftCorner<3, 3>() * normal);
  const double after = normal.dot(noisy.topLeftCorner<3, 3>() * normal);
  EXPECT_GT(after / before, 3);
  EXPECT_LT(after / before, 40);
}

// A face within a larger one: shifts in its plane and turns about its normal are free, but finite.
TEST(PoseCovariance, isLargeButFiniteWhereNothingHolds)
{
  const PpfModel plate = coarselyTrained(plateMesh());
  const Eigen::Isometry3d pose = poseOf(0, {1, 0, 0}, {0, 0, 0.6});
  const Matrix6d covariance = covarianceOf(noisyImage({wall(0.597)}), plate, pose);
  const double shift_m = 0.35 * plate.diameter();
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), shift_m, 0.05 * shift_m);
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), shift_m, 0.05 * shift_m);
  EXPECT_NEAR(std::sqrt(covariance(5, 5)), 1, 0.05);
  EXPECT_LT(std::sqrt(covariance(2, 2)), 0.002);
}

TEST(PoseCovariance, leavesTheTurnOfARevolutionOpen)
{
  const TriangleMesh mesh = cylinderMesh(0.012F, 0.08F, 64);
  const SymmetryAxis axis{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  const Eigen::Isometry3d pose = poseOf(1.3, {1, 0.4, 0}, {0.01, 0, 0.6});
  const RangeImage image = noisyImage({wall(0.8), {mesh, pose}});
  const Matrix6d covariance =
      covarianceOf(image, coarselyTrained(mesh, SymmetryGroup({}, {axis})), pose);
  const Eigen::Matrix3d turns = covariance.bottomRightCorner<3, 3>();
  const Eigen::Vector3d along = pose.linear().col(2), across = pose.linear().col(0);
  EXPECT_NEAR(along.dot(turns * along), M_PI * M_PI / 3, 0.1);
  EXPECT_LT(across.dot(turns * across), 0.01);
}

// The same part drawn about another origin: the same turns, and shifts of that other point.
TEST(PoseCovariance, isAboutTheMeshsOrigin)
{
  const Eigen::Vector3f offset(0.2F, -0.1F, 0.05F);
  const Eigen::Isometry3d pose = poseOf(0.5, {1, 0.4, 0}, {0.01, 0, 0.6});
  const Eigen::Isometry3d far_pose = pose * Eigen::Translation3d(-offset.cast<double>());
  const RangeImage image = noisyImage({wall(0.8), {plateMesh(), pose}});
  const Matrix6d near = covarianceOf(image, coarselyTrained(plateMesh()), pose);
  const Matrix6d far = covarianceOf(image, coarselyTrained(shifted(plateMesh(), offset)), far_pose);
  const Eigen::Vector3d arm = far_pose.translation() - pose.translation();
  Matrix6d map = Matrix6d::Identity();
  for (int k = 0; k < 3; ++k)
    map.block<3, 1>(0, 3 + k) = Eigen::Vector3d::Unit(k).cross(arm);
  const Matrix6d expected = map * near * map.transpose();
  EXPECT_TRUE(far.isApprox(expected, 0.05)) << far << "\n\n" << expected;
}
}  // namespace
}  // namespace ppf_bin_picking

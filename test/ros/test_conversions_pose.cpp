#include "ppf_bin_picking/ros/conversions.hpp"

#include <gtest/gtest.h>

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking_ros
{
namespace
{
TEST(ToPoseWithCovariance, keepsAnUnknownOne)
{
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY()));
  const geometry_msgs::PoseWithCovariance pose = toPoseWithCovariance(
      turn, Eigen::Isometry3d::Identity(), ppf_bin_picking::unknownCovariance());
  EXPECT_EQ(pose.covariance[0], -1.0);
  EXPECT_EQ(std::count(pose.covariance.begin() + 1, pose.covariance.end(), 0.0), 35);
}

TEST(ToPoseWithCovariance, turnsItIntoTheTargetFrame)
{
  Eigen::Isometry3d T_target_cloud = Eigen::Isometry3d::Identity();
  T_target_cloud.translate(Eigen::Vector3d(1, 2, 3))
      .rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  Eigen::Isometry3d T_cloud_model = Eigen::Isometry3d::Identity();
  T_cloud_model.translate(Eigen::Vector3d(0.1, 0.2, 0.3));
  ppf_bin_picking::Matrix6d covariance = ppf_bin_picking::Matrix6d::Zero();
  covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  covariance(0, 3) = covariance(3, 0) = 0.5;
  const geometry_msgs::PoseWithCovariance pose =
      toPoseWithCovariance(T_target_cloud, T_cloud_model, covariance);
  Eigen::Isometry3d back;
  tf2::fromMsg(pose.pose, back);
  EXPECT_TRUE(back.isApprox(T_target_cloud * T_cloud_model, 1e-12));
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> turned(
      pose.covariance.data());
  ppf_bin_picking::Matrix6d expected = ppf_bin_picking::Matrix6d::Zero();
  expected.diagonal() << 2, 1, 3, 5, 4, 6;
  expected(1, 4) = expected(4, 1) = 0.5;
  EXPECT_TRUE(turned.isApprox(expected, 1e-12));
}
}  // namespace
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/detection_view.hpp"

#include "support/detection_views.hpp"

#include <gtest/gtest.h>

#include <tf2_eigen/tf2_eigen.h>

namespace ppf_bin_picking_ros
{
namespace
{
Eigen::Isometry3d toEigen(const geometry_msgs::Pose& message)
{
  Eigen::Isometry3d pose;
  tf2::fromMsg(message, pose);
  return pose;
}

TEST(PickablePoses, areTheReliableOnesInTheTargetFrame)
{
  const DetectionView view = exampleView();
  const auto poses = pickablePoses(view, 0);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].id, "nut/1");
  EXPECT_EQ(poses[1].id, "pin/2");
  EXPECT_EQ(poses[0].model_id, "nut");
  EXPECT_FLOAT_EQ(poses[0].score, 0.9F);
  EXPECT_FLOAT_EQ(poses[0].reliability, 0.95F);
  const Eigen::Isometry3d T_target_model = exampleTransform() * shift(0, 0, 0.5);
  EXPECT_TRUE(toEigen(poses[0].pose.pose).isApprox(T_target_model, 1e-12));
  EXPECT_EQ(poses[0].pose.covariance[0], -1.0);
  ASSERT_EQ(poses[0].picks.size(), 1U);
  EXPECT_TRUE(toEigen(poses[0].picks[0]).isApprox(T_target_model * shift(0, 0, 0.02), 1e-12));
}

TEST(PickablePoses, areLimitedToTheBest)
{
  const auto poses = pickablePoses(exampleView(), 1);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].id, "nut/1");
}

TEST(MismatchRegions, keepEveryFigure)
{
  const auto regions = mismatchRegions(exampleView());
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].id, "pin/region-1");
  EXPECT_EQ(regions[0].model_id, "pin");
  EXPECT_EQ(regions[0].reason, msg::MismatchRegion::SLIPPAGE);
  EXPECT_TRUE(toEigen(regions[0].pose).isApprox(exampleTransform() * shift(0, 0.1, 0.5), 1e-12));
  EXPECT_TRUE(
      toEigen(regions[0].best_pose).isApprox(exampleTransform() * shift(0, 0.1, 0.6), 1e-12));
  EXPECT_EQ(regions[0].size.x, 0.2);
  EXPECT_EQ(regions[0].size.y, 0.1);
  EXPECT_EQ(regions[0].hypotheses, 12U);
  EXPECT_FLOAT_EQ(regions[0].score, 0.7F);
  EXPECT_FLOAT_EQ(regions[0].reliability, 0.3F);
  EXPECT_EQ(regions[0].detail, "slides");
}

TEST(MismatchRegion, hasTheReasonsOfTheCore)
{
  using ppf_bin_picking::UnreliableReason;
  EXPECT_EQ(static_cast<int>(UnreliableReason::kSpread), msg::MismatchRegion::SPREAD);
  EXPECT_EQ(static_cast<int>(UnreliableReason::kSlippage), msg::MismatchRegion::SLIPPAGE);
  EXPECT_EQ(static_cast<int>(UnreliableReason::kLowScore), msg::MismatchRegion::LOW_SCORE);
  EXPECT_EQ(static_cast<int>(UnreliableReason::kOverlap), msg::MismatchRegion::OVERLAP);
  EXPECT_EQ(static_cast<int>(UnreliableReason::kRunnerUp), msg::MismatchRegion::RUNNER_UP);
}

TEST(ToPoseArray, holdsThePickablePoses)
{
  const DetectionView view = exampleView();
  const geometry_msgs::PoseArray array = toPoseArray(view);
  EXPECT_EQ(array.header.frame_id, "base_link");
  EXPECT_EQ(array.header.stamp, ros::Time(5, 6));
  const auto poses = pickablePoses(view, 0);
  ASSERT_EQ(array.poses.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_TRUE(toEigen(array.poses[i]).isApprox(toEigen(poses[i].pose.pose)));
}
}  // namespace
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/debug_clouds.hpp"

#include "support/detection_views.hpp"

#include <gtest/gtest.h>

#include <sensor_msgs/point_cloud2_iterator.h>

namespace ppf_bin_picking_ros
{
namespace
{
struct ColoredPoint
{
  Eigen::Vector3f point;
  Eigen::Vector3i color;
};

std::vector<ColoredPoint> pointsOf(const sensor_msgs::PointCloud2& cloud)
{
  std::vector<ColoredPoint> points;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> red(cloud, "r");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> green(cloud, "g");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> blue(cloud, "b");
  for (; x != x.end(); ++x, ++red, ++green, ++blue)
    points.push_back({{x[0], x[1], x[2]}, {*red, *green, *blue}});
  return points;
}

TEST(DistributionCloud, holdsTheCentresInTheTargetFrameColouredByCluster)
{
  const DetectionView view = exampleView();
  const sensor_msgs::PointCloud2 cloud = distributionCloud(view);
  EXPECT_EQ(cloud.header.frame_id, "base_link");
  const auto points = pointsOf(cloud);
  ASSERT_EQ(points.size(), 3U);
  const Eigen::Vector3f expected =
      (exampleTransform() * Eigen::Vector3d(0.1, 0.2, 0.3)).cast<float>();
  EXPECT_LT((points[0].point - expected).norm(), 1e-6F);
  EXPECT_EQ(points[0].color, points[1].color);
  EXPECT_NE(points[0].color, points[2].color);
  EXPECT_EQ(points[2].color, Eigen::Vector3i(140, 140, 140));  // noise is grey
}

TEST(OrientationCloud, holdsAxisTimesAngleOverPi)
{
  DetectionView view = exampleView();
  view.T_target_cloud = Eigen::Isometry3d::Identity();
  const auto points = pointsOf(orientationCloud(view));
  ASSERT_EQ(points.size(), 3U);
  EXPECT_LT(points[0].point.norm(), 1e-6F);
  EXPECT_LT((points[1].point - Eigen::Vector3f(2.0F / 3.14159265F, 0, 0)).norm(), 1e-6F);
}

TEST(OrientationCloud, staysInTheUnitBall)
{
  DetectionView view = exampleView();
  view.result.distribution.assign(200, {});
  for (int i = 0; i < 200; ++i)
    view.result.distribution[static_cast<std::size_t>(i)].rotation =
        Eigen::AngleAxisf(0.1F * static_cast<float>(i), Eigen::Vector3f(1, 1, 1).normalized());
  for (const ColoredPoint& point : pointsOf(orientationCloud(view)))
    EXPECT_LE(point.point.norm(), 1.0F + 1e-6F);
}

TEST(SceneCloud, holdsTheSampledScene)
{
  const auto points = pointsOf(sceneCloud(exampleView()));
  ASSERT_EQ(points.size(), 2U);
  const Eigen::Vector3f expected = (exampleTransform() * Eigen::Vector3d(4, 5, 6)).cast<float>();
  EXPECT_LT((points[1].point - expected).norm(), 1e-5F);
}
}  // namespace
}  // namespace ppf_bin_picking_ros

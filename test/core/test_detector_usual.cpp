#include "ppf_bin_picking/core/detector.hpp"

#include "support/bracket_and_angle.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kWall_m = 0.6F;
constexpr int kHole_px = 4;  // half its side

/// Brackets in rows before a wall; of each the same square, in its middle, shows the wall.
PointCloud bracketsWithHoles(int rows, int columns)
{
  const PinholeCamera camera = smallCamera();
  std::vector<PlacedMesh> placed = {wall(kWall_m)};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      placed.push_back({bracketMesh(), poseOf(M_PI, {1, 0, 0},
                                              {0.095 * (column - 0.5 * (columns - 1)),
                                               0.07 * (row - 0.5 * (rows - 1)), kWall_m - 0.001})});
  PointCloud cloud = renderCloud(placed, camera, 0.0002F);
  for (std::size_t i = 1; i < placed.size(); ++i)
  {
    const Eigen::Vector2f middle =
        camera.project(placed[i].T_camera_mesh.translation().cast<float>());
    for (int v = -kHole_px; v < kHole_px; ++v)
      for (int u = -kHole_px; u < kHole_px; ++u)
      {
        const auto x = static_cast<int>(std::lround(middle.x())) + u;
        const auto y = static_cast<int>(std::lround(middle.y())) + v;
        Eigen::Vector3f& point = cloud.points[static_cast<std::size_t>(y * camera.width + x)];
        point *= kWall_m / point.z();
      }
  }
  return cloud;
}

DetectionResult detect(int rows, int columns)
{
  static const PpfModel bracket =
      PpfModel::train(bracketMesh(), SymmetryGroup(), coarseConfig().model);
  const RegionOfInterest roi{
      Eigen::Isometry3d::Identity(), {-0.2, -0.2, 0.5}, {0.2, 0.2, kWall_m - 0.003}};
  return Detector(coarseConfig()).detect(bracketsWithHoles(rows, columns), bracket, roi);
}

TEST(DetectorUsual, whatIsSeenBehindEveryPartIsUsual)
{
  const DetectionResult result = detect(3, 3);
  ASSERT_EQ(result.poses.size(), 9U);
  for (const DetectedPose& pose : result.poses)
  {
    EXPECT_TRUE(pose.reliable);
    EXPECT_GT(pose.looked_through, 0.01);
    EXPECT_NEAR(pose.usual_looked_through, pose.looked_through, 0.01);
  }
}

TEST(DetectorUsual, whatIsSeenBehindFewIsNot)
{
  const DetectionResult result = detect(2, 3);
  ASSERT_EQ(result.poses.size(), 6U);
  for (const DetectedPose& pose : result.poses)
  {
    EXPECT_GT(pose.looked_through, 0.01);
    EXPECT_EQ(pose.usual_looked_through, 0);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

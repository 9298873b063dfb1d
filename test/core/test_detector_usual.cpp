#include "ppf_bin_picking/core/detector.hpp"
#include "ppf_bin_picking/core/reliability.hpp"

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

/// Up to nine brackets in rows of three before a wall; of each a square in its middle, of the last
/// one a larger one, shows the wall.
PointCloud bracketsWithHoles(int count, int last_hole_px)
{
  const PinholeCamera camera = smallCamera();
  std::vector<PlacedMesh> placed = {wall(kWall_m)};
  for (int i = 0; i < count; ++i)
    placed.push_back(
        {bracketMesh(),
         poseOf(M_PI, {1, 0, 0}, {0.095 * (i % 3 - 1), 0.07 * (i / 3 - 1), kWall_m - 0.001})});
  PointCloud cloud = renderCloud(placed, camera, 0.0002F);
  for (std::size_t i = 1; i < placed.size(); ++i)
  {
    const Eigen::Vector2f middle =
        camera.project(placed[i].T_camera_mesh.translation().cast<float>());
    const int hole_px = i + 1 < placed.size() ? kHole_px : last_hole_px;
    for (int v = -hole_px; v < hole_px; ++v)
      for (int u = -hole_px; u < hole_px; ++u)
      {
        const auto x = static_cast<int>(std::lround(middle.x())) + u;
        const auto y = static_cast<int>(std::lround(middle.y())) + v;
        Eigen::Vector3f& point = cloud.points[static_cast<std::size_t>(y * camera.width + x)];
        point *= kWall_m / point.z();
      }
  }
  return cloud;
}

DetectionResult detect(int count, const DetectorConfig& config = coarseConfig(),
                       int last_hole_px = kHole_px)
{
  static const PpfModel bracket =
      PpfModel::train(bracketMesh(), SymmetryGroup(), coarseConfig().model);
  const RegionOfInterest roi{
      Eigen::Isometry3d::Identity(), {-0.2, -0.2, 0.5}, {0.2, 0.2, kWall_m - 0.003}};
  return Detector(config).detect(bracketsWithHoles(count, last_hole_px), bracket, roi);
}

TEST(DetectorUsual, whatIsSeenBehindEveryPartIsUsual)
{
  const DetectionResult result = detect(9);
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
  const DetectionResult result = detect(6);
  ASSERT_EQ(result.poses.size(), 6U);
  for (const DetectedPose& pose : result.poses)
  {
    EXPECT_GT(pose.looked_through, 0.01);
    EXPECT_EQ(pose.usual_looked_through, 0);
  }
}

TEST(DetectorUsual, posesShowItThatPassTheTestsEvenWhereTheseAreSwitchedOff)
{
  DetectorConfig untested = coarseConfig();
  untested.mismatch_test = false;
  const DetectionResult result = detect(7, untested, 14);
  ASSERT_EQ(result.poses.size(), 7U);
  int doubtful = 0;
  for (const DetectedPose& pose : result.poses)
  {
    EXPECT_TRUE(pose.reliable);
    doubtful += pose.reliability < kShowsUsual;
    if (pose.reliability >= kShowsUsual)
    {
      EXPECT_EQ(pose.usual_looked_through, 0);
    }
  }
  EXPECT_EQ(doubtful, 1);
}
}  // namespace
}  // namespace ppf_bin_picking

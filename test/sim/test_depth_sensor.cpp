#include "ppf_bin_picking/sim/depth_camera.hpp"
#include "ppf_bin_picking/sim/depth_sensor.hpp"

#include "support/depth_shots.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
TEST(DepthSensor, hasTheNoiseAskedFor)
{
  DepthSensor sensor = smallSensor();
  sensor.noise_at_1m_m = 0.0008;
  sensor.lateral_noise_px = 0.4;
  for (const double distance_m : {0.5, 1.0})
    for (const double slant_rad : {0.0, 1.0})
    {
      SCOPED_TRACE(testing::Message() << distance_m << " m, " << slant_rad << " rad");
      const Plate plate{distance_m, slant_rad};
      const DepthView view = plate.shot(sensor, 3);
      std::vector<double> errors;     // relative to what they should be
      std::vector<double> in_middle;  // [m], of the rows where distance and slant are those given
      for (int row = 0; row < 240; ++row)
        for (int column = 0; column < 320; ++column)
        {
          const double depth = plate.depth(sensor.camera, row);
          const double error = depthAt(view, column, row) - depth;
          const double slope =
              plate.depth(sensor.camera, row + 0.5) - plate.depth(sensor.camera, row - 0.5);
          errors.push_back(error / std::hypot(0.0008 * depth * depth, 0.4 * slope));
          if (std::abs(row - 120) < 10) in_middle.push_back(error);
        }
      const Spread all(errors);
      EXPECT_NEAR(all.mean, 0, 0.015);  // 4 standard errors of 76800 values
      EXPECT_NEAR(all.std, 1, 0.012);
      const double lateral_m = 0.4 * distance_m / 560 * std::tan(slant_rad);
      const double expected_m = std::hypot(0.0008 * distance_m * distance_m, lateral_m);
      const Spread middle(in_middle);
      EXPECT_NEAR(middle.std / expected_m, 1, 0.04);
      EXPECT_NEAR(middle.mean / expected_m, 0, 0.05);
    }
}

TEST(DepthSensor, turnsLateralNoiseIntoDepthByTheFocalLengthAlongTheSlope)
{
  DepthSensor sensor = smallSensor();
  sensor.lateral_noise_px = 0.5;
  sensor.camera.fx = 4 * sensor.camera.fy;
  const TriangleMesh square = squareMesh(5);
  for (const bool along_x : {true, false})
  {
    SCOPED_TRACE(along_x);
    const Eigen::Vector3d axis = along_x ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    const Eigen::Isometry3d T_camera_plate(Eigen::Translation3d(0, 0, 0.6) *
                                           Eigen::AngleAxisd(0.9, axis));
    const RayCaster world({{&square, T_camera_plate}});
    const auto shot = [&](const DepthSensor& kind)
    { return takeShot(world, kind, Eigen::Isometry3d::Identity(), 5); };
    DepthSensor perfect = sensor;
    perfect.lateral_noise_px = 0;
    const DepthView view = shot(sensor), truth = shot(perfect);
    std::vector<double> errors;  // in the middle, where the slant is that of the plate
    for (int row = 110; row < 130; ++row)
      for (int column = 80; column < 240; ++column)
        errors.push_back(depthAt(view, column, row) - depthAt(truth, column, row));
    const double focal_px = along_x ? sensor.camera.fx : sensor.camera.fy;
    EXPECT_NEAR(Spread(errors).std / (0.5 * 0.6 / focal_px * std::tan(0.9)), 1, 0.06);
  }
}

TEST(DepthSensor, hasNothingWhereTheProjectorIsHidden)
{
  const BoxOnFloor scene;
  for (const double baseline_m : {0.2, -0.1})
  {
    SCOPED_TRACE(baseline_m);
    DepthSensor sensor = smallSensor();
    sensor.baseline_m = baseline_m;
    const DepthView view = scene.shot(sensor);
    // The shadow reaches from the box's top edge, as the camera sees it, to where the projector's
    // ray through that edge meets the floor. Its side is away from the projector.
    const double side = baseline_m > 0 ? -1 : 1;
    const double edge = 0.02 * side;
    const double end = edge + (edge - baseline_m) * 0.05 / (0.6 - 0.05);
    const double first_column = sensor.camera.cx + 560 * edge / 0.55;
    const double last_column = sensor.camera.cx + 560 * end / 0.6;
    for (int column = 0; column < 320; ++column)
    {
      const double from_start = side * (column - first_column);
      const double to_end = side * (last_column - column);
      if (std::abs(from_start) < 1 || std::abs(to_end) < 1) continue;  // the border itself
      const bool in_shadow = from_start > 0 && to_end > 0;
      EXPECT_EQ(std::isfinite(depthAt(view, column, 120)), !in_shadow) << column;
      EXPECT_TRUE(std::isfinite(depthAt(view, column, 10))) << column;  // beside the box
    }
    EXPECT_GT(std::abs(last_column - first_column), 5);
    EXPECT_EQ(std::count(view.object.begin(), view.object.end(), -1), 0);  // seen all the same
  }
  EXPECT_EQ(measured(scene.shot(smallSensor())), 320 * 240);
}

TEST(DepthSensor, hasNothingOnTheSideTurnedFromTheProjector)
{
  // A sheet between camera and projector is seen from one side and lit on the other.
  DepthSensor sensor = smallSensor();
  sensor.baseline_m = 1;
  const TriangleMesh square = squareMesh(0.1F);
  Eigen::Isometry3d T_camera_square(Eigen::Translation3d(0.1, 0, 0.6));
  T_camera_square.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  const RayCaster world({{&square, T_camera_square}});
  EXPECT_EQ(measured(takeShot(world, sensor, Eigen::Isometry3d::Identity(), 1)), 0);
  sensor.baseline_m = 0;
  EXPECT_GT(measured(takeShot(world, sensor, Eigen::Isometry3d::Identity(), 1)), 500);
}

TEST(DepthSensor, roundsTheDepth)
{
  DepthSensor sensor = smallSensor();
  sensor.depth_step_m = 0.002;
  const Plate plate{0.6, 0.5};
  const DepthView view = plate.shot(sensor);
  for (int row = 0; row < 240; ++row)
  {
    const double depth = depthAt(view, 100, row);
    EXPECT_NEAR(depth / 0.002, std::round(depth / 0.002), 1e-3);
    EXPECT_LT(std::abs(depth - plate.depth(sensor.camera, row)), 0.001 + 1e-6);
    const Eigen::Vector3f& point = view.cloud_camera.points[row * 320 + 100];  // still on its ray
    EXPECT_NEAR(sensor.camera.project(point).y(), row, 1e-3);
  }
}

TEST(DepthSensor, missesWhatIsSeenOrLitAtAFlatAngle)
{
  DepthSensor sensor = smallSensor();
  sensor.max_slant_rad = 1.15;
  for (const double baseline_m : {0.0, 0.5})
  {
    sensor.baseline_m = baseline_m;
    const Plate plate{0.6, 1.1};
    const DepthView view = plate.shot(sensor);
    const Eigen::Vector3d normal(0, std::sin(1.1), std::cos(1.1));
    int missing = 0;
    for (int row = 0; row < 240; ++row)
      for (int column = 0; column < 320; ++column)
      {
        const Eigen::Vector3d point =
            sensor.camera.ray(static_cast<float>(column), static_cast<float>(row)).cast<double>() *
            plate.depth(sensor.camera, row);
        const Eigen::Vector3d from_projector = point - Eigen::Vector3d(baseline_m, 0, 0);
        const double slant_rad = std::max(std::acos(normal.dot(point.normalized())),
                                          std::acos(normal.dot(from_projector.normalized())));
        if (std::abs(slant_rad - 1.15) < 1e-4) continue;
        ASSERT_EQ(std::isfinite(depthAt(view, column, row)), slant_rad < 1.15);
        missing += slant_rad > 1.15;
      }
    EXPECT_GT(missing, 1000);
    EXPECT_LT(missing, 320 * 240 - 1000);
    EXPECT_EQ(view.object[0], 0);  // seen, though not measured
  }
}

TEST(DepthSensor, isDazzledWhereThePlateMirrorsTheProjector)
{
  DepthSensor sensor = smallSensor();
  sensor.baseline_m = 0.1;
  sensor.glare_rad = 0.05;
  const DepthView view = Plate{0.5, 0}.shot(sensor);
  // Half-way between camera and projector, above x = 50 mm, the mirror is exact.
  const double middle = sensor.camera.cx + 560 * 0.05 / 0.5;
  int missing = 0;
  double sum = 0;
  for (int row = 0; row < 240; ++row)
    for (int column = 0; column < 320; ++column)
      if (!std::isfinite(depthAt(view, column, row)))
      {
        ++missing;
        sum += column;
      }
  ASSERT_GT(missing, 0);
  EXPECT_NEAR(sum / missing, middle, 0.6);
  // Down the image the mirror turns by the angle from the middle: tan(angle) = y / sqrt(z^2 +
  // b^2/4)
  const double half_height = 560 * std::tan(0.05) * std::hypot(0.5, 0.05) / 0.5;
  const int column = static_cast<int>(std::lround(middle));
  int in_column = 0;
  for (int row = 0; row < 240; ++row)
    in_column += !std::isfinite(depthAt(view, column, row));
  EXPECT_NEAR(in_column, 2 * half_height, 2.5);
  sensor.glare_rad = 0;
  EXPECT_EQ(measured(Plate{0.5, 0}.shot(sensor)), 320 * 240);
}

/// Whether a pair of neighbours within `reach` pixels differs by more than a step; slow and plain.
bool nearEdge(const DepthView& truth, const DepthSensor& sensor, int column, int row, int reach)
{
  const auto within = [&](int u, int v)
  {
    return u >= 0 && v >= 0 && u < sensor.camera.width && v < sensor.camera.height &&
           std::abs(u - column) <= reach && std::abs(v - row) <= reach;
  };
  for (int v = row - reach; v <= row + reach; ++v)
    for (int u = column - reach; u <= column + reach; ++u)
      for (const auto& [du, dv] : {std::pair{1, 0}, std::pair{0, 1}})
        if (within(u, v) && within(u + du, v + dv) &&
            std::abs(depthAt(truth, u, v) - depthAt(truth, u + du, v + dv)) > sensor.edge_step_m)
          return true;
  return false;
}

TEST(DepthSensor, letsPixelsFlyNearDepthEdgesAlone)
{
  const BoxOnFloor scene;
  for (const double baseline_m : {0.0, 0.15})
    for (const int reach : {1, 3})
    {
      SCOPED_TRACE(testing::Message() << baseline_m << " m, " << reach << " px");
      DepthSensor sensor = smallSensor();
      sensor.baseline_m = baseline_m;
      const DepthView truth = scene.shot(sensor);
      sensor.flying_share = 0.3;
      sensor.flying_reach_px = reach;
      const DepthView view = scene.shot(sensor, 2);
      int flying = 0;
      int may_fly = 0;
      std::vector<double> heights;
      for (int row = 0; row < 240; ++row)
        for (int column = 0; column < 320; ++column)
        {
          const float depth = depthAt(view, column, row);
          const float expected = depthAt(truth, column, row);
          ASSERT_EQ(std::isfinite(depth), std::isfinite(expected));
          if (!std::isfinite(depth)) continue;
          const bool edge = nearEdge(truth, sensor, column, row, reach);
          may_fly += edge;
          if (std::abs(depth - expected) < 1e-6) continue;
          ASSERT_TRUE(edge) << column << ", " << row;
          ++flying;
          heights.push_back((0.6 - depth) / 0.05);
        }
      ASSERT_GT(may_fly, 200);
      ASSERT_GT(flying, 0);
      const double share = static_cast<double>(flying) / may_fly;
      EXPECT_NEAR(share, 0.3, 4 * std::sqrt(0.3 * 0.7 / may_fly));
      // Anywhere between floor and top.
      EXPECT_NEAR(Spread(heights).mean, 0.5, 0.1);
      EXPECT_NEAR(Spread(heights).std, std::sqrt(1.0 / 12), 0.04);
      EXPECT_GT(*std::min_element(heights.begin(), heights.end()), -1e-5);
      EXPECT_LT(*std::max_element(heights.begin(), heights.end()), 1 + 1e-5);
    }
}

TEST(DepthSensor, seesNoDepthEdgeOnASlope)
{
  DepthSensor sensor = smallSensor();
  sensor.flying_share = 1;
  const Plate plate{0.6, 1.2};  // at most 2.8 mm a pixel from the middle down
  const DepthView view = plate.shot(sensor);
  for (int row = 120; row < 240; ++row)
    ASSERT_NEAR(depthAt(view, 50, row), plate.depth(sensor.camera, row), 2e-6);
}

TEST(DepthSensor, dropsSinglePixels)
{
  DepthSensor sensor = smallSensor();
  sensor.dropout_share = 0.1;
  const DepthView view = Plate{0.6, 0}.shot(sensor);
  const double missing = 1 - measured(view) / (320.0 * 240.0);
  EXPECT_NEAR(missing, 0.1, 4 * std::sqrt(0.1 * 0.9 / (320 * 240)));
  int pairs = 0;  // side by side no more often than chance has it
  for (int row = 0; row < 240; ++row)
    for (int column = 0; column + 1 < 320; ++column)
      pairs += std::isnan(depthAt(view, column, row)) && std::isnan(depthAt(view, column + 1, row));
  EXPECT_NEAR(pairs, 0.01 * 319 * 240, 4 * std::sqrt(0.01 * 319 * 240));
}

}  // namespace
}  // namespace ppf_bin_picking

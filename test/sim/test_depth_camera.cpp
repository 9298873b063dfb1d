#include "ppf_bin_picking/sim/depth_camera.hpp"
#include "ppf_bin_picking/sim/part_pile.hpp"

#include "support/depth_shots.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
TEST(TakeShot, seesAPlaneWhereItIs)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  const Eigen::Isometry3d T_world_camera = lookAt({0.1, -0.2, 0.7}, {0, 0.05, 0});
  const DepthView view = takeShot(world, smallSensor(), T_world_camera, 1);
  ASSERT_EQ(view.cloud_camera.size(), 320U * 240U);
  EXPECT_TRUE(view.cloud_camera.organised());
  for (const Eigen::Vector3f& p_camera : view.cloud_camera.points)
    ASSERT_NEAR((T_world_camera * p_camera.cast<double>()).z(), 0, 1e-6);
  // The target lies in the middle of the image, the pixel to the right of it further along x.
  const std::size_t middle = 120U * 320U + 160U;
  const Eigen::Vector3d seen = T_world_camera * view.cloud_camera.points[middle].cast<double>();
  EXPECT_LT((seen - Eigen::Vector3d(0, 0.05, 0)).norm(), 0.002);
  EXPECT_GT(view.cloud_camera.points[middle + 1].x(), view.cloud_camera.points[middle].x());
}

TEST(TakeShot, seesASlantedPlaneAsTheFormulaSays)
{
  const DepthSensor sensor = smallSensor();
  const Plate plate{0.8, 1.2};
  const DepthView view = plate.shot(sensor);
  for (int row = 0; row < 240; ++row)
    for (int column = 0; column < 320; column += 7)
      ASSERT_NEAR(depthAt(view, column, row), plate.depth(sensor.camera, row), 2e-6);
}

TEST(TakeShot, seesASphereAsTheFormulaSays)
{
  const double radius = 0.05;
  const TriangleMesh sphere = sphereMesh(static_cast<float>(radius));
  const RayCaster world({{&sphere, Eigen::Isometry3d::Identity()}});
  const DepthSensor sensor = smallSensor();
  const Eigen::Vector3d position(0, -0.1, 0.5);
  const DepthView view = takeShot(world, sensor, lookAt(position, {0, 0, 0}), 1);
  const double distance = position.norm();
  int hits = 0;
  for (int row = 0; row < sensor.camera.height; ++row)
    for (int column = 0; column < sensor.camera.width; ++column)
    {
      const Eigen::Vector3d ray =
          sensor.camera.ray(static_cast<float>(column), static_cast<float>(row))
              .cast<double>()
              .normalized();
      const double aside = distance * std::hypot(ray.x(), ray.y());
      const Eigen::Vector3f& point = view.cloud_camera.points[row * sensor.camera.width + column];
      if (aside > radius)
      {
        ASSERT_FALSE(point.allFinite());
      }
      if (aside > 0.98 * radius) continue;  // the rim, where facets matter
      const double range = distance * ray.z() - std::sqrt(radius * radius - aside * aside);
      ASSERT_NEAR(point.norm(), range, 3e-4);
      ++hits;
    }
  EXPECT_GT(hits, 5000);
}

TEST(TakeShot, givesTheSameBytesForAnyNumberOfThreads)
{
  const TriangleMesh bin = binMesh({});
  const TriangleMesh part = angleMesh();
  std::vector<PlacedMesh> meshes = {{&bin, Eigen::Isometry3d::Identity()}};
  PartPile pile({}, part, convexHulls(part));
  pile.drop(8, 5);
  for (const auto& pose : pile.poses())
    meshes.push_back({&part, pose});
  const auto shoot = [&](const std::string& preset, int threads, std::uint32_t seed)
  {
    const RayCaster world(meshes);
    DepthSensor sensor = sensorPreset(preset);
    sensor.camera = smallSensor().camera;
    return takeShot(world, sensor, lookAt({0, -0.1, 0.7}, {0, 0, 0}), seed, threads);
  };
  const auto same = [](const DepthView& a, const DepthView& b)
  {
    return std::memcmp(a.cloud_camera.points.data(), b.cloud_camera.points.data(),
                       a.cloud_camera.size() * sizeof(Eigen::Vector3f)) == 0 &&
           a.object == b.object && a.brightness == b.brightness;
  };
  for (const std::string preset : {"industrial", "low_cost"})
  {
    const DepthView one = shoot(preset, 1, 7);
    EXPECT_TRUE(same(one, shoot(preset, 1, 7)));
    EXPECT_TRUE(same(one, shoot(preset, 2, 7)));
    EXPECT_TRUE(same(one, shoot(preset, 4, 7)));
    EXPECT_FALSE(same(one, shoot(preset, 1, 8)));
  }
  EXPECT_TRUE(same(shoot("clean", 1, 7), shoot("clean", 2, 8)));  // nothing left to chance
}

TEST(TakeShot, refusesASensorOutOfRange)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  DepthSensor sensor = smallSensor();
  sensor.camera.fx = 0;
  sensor.noise_at_1m_m = std::nan("");
  try
  {
    takeShot(world, sensor, Eigen::Isometry3d::Identity(), 1);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(),
                 "the depth sensor's fx is 0: give a value from 1 to 100000; noise_at_1m_m is nan: "
                 "give a value from 0 to 1");
  }
  EXPECT_THROW(lookAt({1, 0, 0}, {0, 0, 0}), std::invalid_argument);
}

TEST(SensorPreset, knowsItsNames)
{
  for (const std::string& name : sensorPresetNames())
    EXPECT_TRUE(sensorPreset(name).problems().empty()) << name;
  try
  {
    sensorPreset("industry");
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(),
                 "there is no sensor preset 'industry': give one of clean, industrial, low_cost");
  }
}

TEST(PartTruths, tellsWhatIsSeenOfAPart)
{
  const TriangleMesh part = boxMesh({0.04F, 0.04F, 0.04F});
  const TriangleMesh roof = squareMesh(0.02F);
  std::vector<Eigen::Isometry3d> T_world_part(3, Eigen::Isometry3d::Identity());
  T_world_part[1].translation().x() = 0.06;   // half under the roof
  T_world_part[2].translation().x() = 0.165;  // cut off by the image's border
  Eigen::Isometry3d T_world_roof = Eigen::Isometry3d::Identity();
  T_world_roof.translation() = Eigen::Vector3d(0.08, 0, 0.02001);
  const RayCaster world({{&roof, T_world_roof},
                         {&part, T_world_part[0]},
                         {&part, T_world_part[1]},
                         {&part, T_world_part[2]}});
  const Eigen::Isometry3d T_world_camera = lookAt({0, 0, 0.6}, {0, 0, 0});
  DepthSensor sensor = smallSensor();
  const DepthView view = takeShot(world, sensor, T_world_camera, 1);
  const auto truths = partTruths(view, sensor.camera, T_world_camera, part, T_world_part, 1);
  ASSERT_EQ(truths.size(), 3U);
  EXPECT_GT(truths[0].visible_share, 0.999);
  EXPECT_GT(truths[1].visible_share, 0.4);
  EXPECT_LT(truths[1].visible_share, 0.6);
  EXPECT_GT(truths[2].visible_share, 0.999);  // of what the image can show
  // Whatever the sensor misses, the truth is the same.
  sensor.baseline_m = 0.3;
  sensor.dropout_share = 0.9;
  sensor.glare_rad = 0.5;
  const DepthView poor = takeShot(world, sensor, T_world_camera, 1);
  EXPECT_LT(measured(poor), measured(view) / 9);
  const auto same = partTruths(poor, sensor.camera, T_world_camera, part, T_world_part, 1);
  for (std::size_t k = 0; k < truths.size(); ++k)
    EXPECT_EQ(same[k].visible_share, truths[k].visible_share);
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/sim/depth_camera.hpp"
#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
constexpr DepthNoise kPerfect{0, M_PI_2};

/// A quarter of the default image.
PinholeCamera smallCamera()
{
  return {320, 240, 560, 560, 159.5, 119.5};
}

TEST(TakeShot, seesAPlaneWhereItIs)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  const Eigen::Isometry3d T_world_camera = lookAt({0.1, -0.2, 0.7}, {0, 0.05, 0});
  const DepthView view = takeShot(world, smallCamera(), T_world_camera, kPerfect, 1);
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

TEST(TakeShot, seesASphereAsTheFormulaSays)
{
  const double radius = 0.05;
  const TriangleMesh sphere = sphereMesh(static_cast<float>(radius));
  const RayCaster world({{&sphere, Eigen::Isometry3d::Identity()}});
  const PinholeCamera camera = smallCamera();
  const Eigen::Vector3d position(0, -0.1, 0.5);
  const DepthView view = takeShot(world, camera, lookAt(position, {0, 0, 0}), kPerfect, 1);
  const double distance = position.norm();
  int hits = 0;
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column)
    {
      const Eigen::Vector3d ray = camera.ray(static_cast<float>(column), static_cast<float>(row))
                                      .cast<double>()
                                      .normalized();
      const double aside = distance * std::hypot(ray.x(), ray.y());
      const Eigen::Vector3f& point = view.cloud_camera.points[row * camera.width + column];
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

TEST(TakeShot, hasTheNoiseAskedFor)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  const DepthView view =
      takeShot(world, smallCamera(), lookAt({0, 0, 0.6}, {0, 0, 0}), {0.0005, 1.4}, 3);
  double sum = 0;
  double squares = 0;
  for (const Eigen::Vector3f& point : view.cloud_camera.points)
  {
    sum += point.z() - 0.6;
    squares += (point.z() - 0.6) * (point.z() - 0.6);
  }
  const double count = static_cast<double>(view.cloud_camera.size());
  EXPECT_NEAR(sum / count, 0, 1e-5);
  EXPECT_NEAR(std::sqrt(squares / count), 0.0005, 1e-5);
}

TEST(TakeShot, missesWhatIsSeenAtAFlatAngle)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  const Eigen::Isometry3d T_world_camera = lookAt({0, -0.6, 0.3}, {0, 0, 0});
  const PinholeCamera camera = smallCamera();
  const double limit_rad = std::acos(0.3 / std::hypot(0.6, 0.3));
  const DepthView view = takeShot(world, camera, T_world_camera, {0, limit_rad}, 1);
  EXPECT_FALSE(view.cloud_camera.points[10 * 320 + 160].allFinite());  // far, flat
  EXPECT_TRUE(view.cloud_camera.points[230 * 320 + 160].allFinite());  // near, steep
  EXPECT_EQ(view.object[10 * 320 + 160], 0);
  EXPECT_GT(view.brightness[230 * 320 + 160], view.brightness[10 * 320 + 160]);
}

TEST(TakeShot, givesTheSameBytesForAnyNumberOfThreads)
{
  const TriangleMesh bin = binMesh({});
  const TriangleMesh part = angleMesh();
  std::vector<PlacedMesh> meshes = {{&bin, Eigen::Isometry3d::Identity()}};
  for (const auto& pose : fillBin({}, part, 8, 5))
    meshes.push_back({&part, pose});
  const auto shoot = [&](int threads, std::uint32_t seed)
  {
    const RayCaster world(meshes);
    return takeShot(world, smallCamera(), lookAt({0, -0.1, 0.7}, {0, 0, 0}), {}, seed, threads);
  };
  const auto same = [](const DepthView& a, const DepthView& b)
  {
    return std::memcmp(a.cloud_camera.points.data(), b.cloud_camera.points.data(),
                       a.cloud_camera.size() * sizeof(Eigen::Vector3f)) == 0;
  };
  const DepthView one = shoot(1, 7);
  EXPECT_TRUE(same(one, shoot(2, 7)));
  EXPECT_TRUE(same(one, shoot(4, 7)));
  EXPECT_FALSE(same(one, shoot(1, 8)));
}

TEST(TakeShot, refusesACameraWithoutImage)
{
  const TriangleMesh plane = squareMesh(1);
  const RayCaster world({{&plane, Eigen::Isometry3d::Identity()}});
  PinholeCamera camera = smallCamera();
  camera.fx = 0;
  EXPECT_THROW(takeShot(world, camera, Eigen::Isometry3d::Identity(), {}, 1),
               std::invalid_argument);
  EXPECT_THROW(lookAt({1, 0, 0}, {0, 0, 0}), std::invalid_argument);
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
  const PinholeCamera camera = smallCamera();
  const DepthView view = takeShot(world, camera, T_world_camera, kPerfect, 1);
  const auto truths = partTruths(view, camera, T_world_camera, part, T_world_part, 1);
  ASSERT_EQ(truths.size(), 3U);
  EXPECT_GT(truths[0].visible_share, 0.999);
  EXPECT_GT(truths[1].visible_share, 0.4);
  EXPECT_LT(truths[1].visible_share, 0.6);
  EXPECT_GT(truths[2].visible_share, 0.999);  // of what the image can show
}

TEST(SimulateCell, putsThePartsWhereTheTruthSays)
{
  CellSettings settings;
  settings.noise = kPerfect;
  const TriangleMesh part = angleMesh();
  const CellShot shot = simulateCell(settings, part, 6, 9);
  ASSERT_EQ(shot.parts.size(), 6U);
  const RayCaster alone({{&part, Eigen::Isometry3d::Identity()}});
  int on_parts = 0;
  int above_floor = 0;
  for (const Eigen::Vector3f& point : shot.view.cloud_camera.points)
  {
    const Eigen::Vector3d p_camera = point.cast<double>();
    const Eigen::Vector3d p_bin = shot.T_base_camera * p_camera - settings.bin_position_m;
    const Eigen::Vector3d inside = settings.bin.size_m / 2 - p_bin.cwiseAbs();
    if (!(inside.x() > 1e-4 && inside.y() > 1e-4 && p_bin.z() > 1e-4)) continue;  // bin, or NaN
    ++above_floor;
    for (const PartTruth& truth : shot.parts)
    {
      const Eigen::Isometry3d T_model_camera = truth.T_camera_model.inverse();
      const Eigen::Vector3d away = T_model_camera.linear() * p_camera.normalized();
      const Eigen::Vector3d start = T_model_camera * p_camera - 0.001 * away;
      const auto hit = alone.cast(start.cast<float>(), away.cast<float>());
      if (!hit || std::abs(hit->distance_m - 0.001) > 1e-5) continue;
      ++on_parts;
      break;
    }
  }
  EXPECT_GT(above_floor, 10000);
  EXPECT_EQ(on_parts, above_floor);
  for (const PartTruth& truth : shot.parts)
    EXPECT_GT(truth.visible_share, 0.2);
}
}  // namespace
}  // namespace ppf_bin_picking

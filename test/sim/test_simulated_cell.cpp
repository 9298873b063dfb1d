#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
TEST(SimulateCell, putsThePartsWhereTheTruthSays)
{
  CellSettings settings;
  settings.sensor = sensorPreset("clean");
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

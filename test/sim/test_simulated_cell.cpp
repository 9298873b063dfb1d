#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
CellSettings smallSettings()
{
  CellSettings settings;
  settings.sensor = sensorPreset("industrial");
  settings.sensor.camera = {320, 240, 560, 560, 159.5F, 119.5F};
  return settings;
}

CellPart anglePart()
{
  return {angleMesh(), convexHulls(angleMesh()), {}};
}

bool same(const std::vector<Eigen::Isometry3d>& a, const std::vector<Eigen::Isometry3d>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.matrix() == y.matrix(); });
}

bool same(const PointCloud& a, const PointCloud& b)
{
  return a.size() == b.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.size() * sizeof(Eigen::Vector3f)) == 0;
}

/// Picks at the true poses until nothing can be picked. Returns how many picks failed.
int pickAll(SimulatedCell& cell)
{
  int failed = 0;
  bool picked = true;
  while (picked)
  {
    picked = false;
    for (const Eigen::Isometry3d& part : cell.parts())
    {
      picked = cell.pick(part).outcome == PickOutcome::kTaken;
      if (picked) break;
      ++failed;
    }
  }
  return failed;
}

/// Whether a ray meets the part at a point (all in its frame). On an edge rounding decides, so it
/// may pass a micrometre beside it.
bool meetsAt(const RayCaster& part, const Eigen::Vector3d& point, const Eigen::Vector3d& direction)
{
  for (const double aside : {0.0, -1e-6, 1e-6})
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d start = point - 0.001 * direction + aside * Eigen::Vector3d::Unit(axis);
      const auto hit = part.cast(start.cast<float>(), direction.cast<float>());
      if (hit && std::abs(hit->distance_m - 0.001) < 1e-5) return true;
    }
  return false;
}

TEST(SimulatedCell, putsThePartsWhereTheTruthSays)
{
  CellSettings settings = smallSettings();
  settings.sensor = sensorPreset("clean");
  const TriangleMesh part = angleMesh();
  SimulatedCell cell(settings, anglePart(), 9);
  cell.refill(6);
  const CellShot shot = cell.shot();
  ASSERT_EQ(shot.parts.size(), 6U);
  ASSERT_EQ(cell.parts().size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE((cell.T_base_camera() * shot.parts[i].T_camera_model).isApprox(cell.parts()[i]));
  const RayCaster alone({{&part, Eigen::Isometry3d::Identity()}});
  int on_parts = 0;
  int above_floor = 0;
  for (const Eigen::Vector3f& point : shot.view.cloud_camera.points)
  {
    const Eigen::Vector3d p_camera = point.cast<double>();
    const Eigen::Vector3d p_bin = cell.T_base_bin().inverse() * cell.T_base_camera() * p_camera;
    const Eigen::Vector3d inside = settings.bin.size_m / 2 - p_bin.cwiseAbs();
    if (!(inside.x() > 1e-4 && inside.y() > 1e-4 && p_bin.z() > 1e-4)) continue;  // bin, or NaN
    ++above_floor;
    for (const PartTruth& truth : shot.parts)
    {
      const Eigen::Isometry3d T_model_camera = truth.T_camera_model.inverse();
      const Eigen::Vector3d away = T_model_camera.linear() * p_camera.normalized();
      if (!meetsAt(alone, T_model_camera * p_camera, away)) continue;
      ++on_parts;
      break;
    }
  }
  EXPECT_GT(above_floor, 10000);
  EXPECT_EQ(on_parts, above_floor);
}

TEST(SimulatedCell, isTheSameForTheSameSeedAndCalls)
{
  SimulatedCell a(smallSettings(), anglePart(), 3);
  SimulatedCell b(smallSettings(), anglePart(), 3);
  SimulatedCell other(smallSettings(), anglePart(), 4);
  for (SimulatedCell* cell : {&a, &b, &other})
    cell->refill(3);
  EXPECT_TRUE(same(a.parts(), b.parts()));
  EXPECT_FALSE(same(a.parts(), other.parts()));
  const PointCloud first = a.shot().view.cloud_camera;
  const PointCloud second = a.shot().view.cloud_camera;
  EXPECT_TRUE(same(first, b.shot().view.cloud_camera));
  EXPECT_FALSE(same(first, second));  // new noise
  EXPECT_TRUE(same(a.parts(), b.parts()));
  for (SimulatedCell* cell : {&a, &b})
    cell->refill(2);
  EXPECT_TRUE(same(a.parts(), b.parts()));  // though one has taken more shots
}

TEST(SimulatedCell, takesAPartOutAndLetsTheRestSettle)
{
  SimulatedCell cell(smallSettings(), anglePart(), 5);
  cell.refill(1);
  const Eigen::Isometry3d alone = cell.parts()[0];
  EXPECT_EQ(cell.pick(alone).outcome, PickOutcome::kTaken);
  EXPECT_TRUE(cell.parts().empty());
  EXPECT_TRUE(cell.shot().parts.empty());
  EXPECT_EQ(cell.pick(alone).outcome, PickOutcome::kNoPartThere);
}

TEST(SimulatedCell, changesNothingWhenAPickFails)
{
  SimulatedCell cell(smallSettings(), anglePart(), 6);
  cell.refill(8);
  const auto before = cell.parts();
  for (const Eigen::Isometry3d& part : before)
  {
    const Eigen::Isometry3d turned = part * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
    EXPECT_EQ(cell.pick(turned).outcome, PickOutcome::kNoPartThere);
    const PickVerdict verdict = cell.pick(part);
    if (verdict.outcome == PickOutcome::kTaken) break;
    EXPECT_EQ(verdict.outcome, PickOutcome::kCovered);
    EXPECT_TRUE(same(cell.parts(), before));
  }
  EXPECT_EQ(cell.parts().size(), 7U);
}

TEST(SimulatedCell, canBeEmptiedAndRefilled)
{
  SimulatedCell cell(smallSettings(), anglePart(), 7);
  cell.refill(8);
  pickAll(cell);
  EXPECT_LE(cell.parts().size(), 2U);  // two may hook into each other
  const std::size_t left = cell.parts().size();
  cell.refill(3);
  EXPECT_EQ(cell.parts().size(), left + 3);
  const CellSettings settings = smallSettings();
  for (const Eigen::Isometry3d& part : cell.parts())
  {
    const Eigen::Vector3d p_bin =
        cell.T_base_bin().inverse() * part * Eigen::Vector3d(0.02, 0.015, 0.01);
    EXPECT_LT(std::abs(p_bin.x()), settings.bin.size_m.x() / 2);
    EXPECT_LT(std::abs(p_bin.y()), settings.bin.size_m.y() / 2);
    EXPECT_GT(p_bin.z(), 0);
  }
}

TEST(SimulatedCell, refusesWhatCannotWork)
{
  CellSettings settings = smallSettings();
  settings.pick.contact_m = 0;
  EXPECT_THROW(SimulatedCell(settings, anglePart(), 1), std::invalid_argument);
  EXPECT_THROW(SimulatedCell(smallSettings(), {angleMesh(), {}, {}}, 1), std::invalid_argument);
  settings = smallSettings();
  settings.sensor.camera.height = 0;
  SimulatedCell blind(settings, anglePart(), 1);
  EXPECT_THROW(blind.shot(), std::invalid_argument);
  settings = smallSettings();
  settings.bin.size_m = {0.03, 0.03, 0.03};
  SimulatedCell tiny(settings, anglePart(), 1);
  EXPECT_THROW(tiny.refill(1), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/sim/cell_layout.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDegree = M_PI / 180;

TriangleMesh scaled(TriangleMesh mesh, float factor)
{
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex *= factor;
  return mesh;
}

TEST(MeanShadow, ofAConvexBodyIsAQuarterOfItsSurface)  // Cauchy
{
  EXPECT_NEAR(meanShadow(sphereMesh(0.02F)), M_PI * 0.02 * 0.02, 1e-5);
  const double surface_m2 = 2 * (0.06 * 0.04 + 0.06 * 0.02 + 0.04 * 0.02);
  EXPECT_NEAR(meanShadow(boxMesh({0.06F, 0.04F, 0.02F})), surface_m2 / 4, 0.02 * surface_m2 / 4);
}

TEST(MeanShadow, doesNotDependOnTheMeshsOrigin)
{
  const TriangleMesh part = angleMesh();
  EXPECT_NEAR(meanShadow(shifted(part, {0.3F, -0.2F, 0.1F})), meanShadow(part), 1e-5);
}

TEST(BinFor, fewPartsGetABinOfTheirSize)
{
  const Bin bin = binFor(boxMesh({0.06F, 0.04F, 0.02F}), 3);
  const double diameter_m = std::sqrt(0.0056);
  EXPECT_NEAR(bin.size_m.y(), 2.1 * diameter_m, 1e-6);
  EXPECT_NEAR(bin.size_m.x(), 2.8 * diameter_m, 1e-6);
  EXPECT_NEAR(bin.size_m.z(), 3 * 0.02 + diameter_m / 2, 1e-6);
}

TEST(BinFor, manyPartsCoverTheFloorAsOftenAsPromised)
{
  const TriangleMesh ball = sphereMesh(0.02F);
  for (const int count : {50, 200})
  {
    const Bin bin = binFor(ball, count);
    const double floor_m2 = bin.size_m.x() * bin.size_m.y();
    EXPECT_NEAR(count * M_PI * 0.02 * 0.02 / floor_m2, 1.6, 0.03);
    EXPECT_NEAR(bin.size_m.x() / bin.size_m.y(), 4.0 / 3.0, 1e-9);
  }
}

TEST(BinFor, growsWithThePart)
{
  const TriangleMesh part = angleMesh();
  const Eigen::Vector3d small = binFor(part, 40).size_m;
  const Eigen::Vector3d large = binFor(scaled(part, 3), 40).size_m;
  EXPECT_TRUE(large.isApprox(3 * small, 1e-3)) << small.transpose() << ", " << large.transpose();
}

TEST(BinFor, refusesAMeshWithoutSurface)
{
  EXPECT_THROW(binFor(TriangleMesh(), 3), std::invalid_argument);
}

TEST(CellFor, theWholeBinIsInTheImageAndFillsIt)
{
  for (const std::string& preset : sensorPresetNames())
  {
    SCOPED_TRACE(preset);
    const DepthSensor sensor = sensorPreset(preset);
    const CellSettings cell = cellFor(angleMesh(), 200, sensor);
    const Eigen::Isometry3d T_camera_base =
        lookAt(cell.camera_position_m, cell.camera_target_m).inverse();
    double largest = 0;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {0.0, 1.0})
        {
          const Eigen::Vector3d p_bin = cell.bin.size_m.cwiseProduct(Eigen::Vector3d(x, y, z));
          const Eigen::Vector3d p = T_camera_base * (p_bin + cell.bin_position_m);
          const double u = sensor.camera.fx * p.x() / p.z() / (sensor.camera.width / 2.0);
          const double v = sensor.camera.fy * p.y() / p.z() / (sensor.camera.height / 2.0);
          largest = std::max({largest, std::abs(u), std::abs(v)});
        }
    EXPECT_LE(largest, 0.9);
    EXPECT_GT(largest, 0.85);
  }
}

TEST(CellFor, cameraAndProjectorStandOnEitherSideOfTheMiddle)
{
  const DepthSensor sensor = sensorPreset("industrial");
  const CellSettings cell = cellFor(sphereMesh(0.01F), 2, sensor);
  const double above_m = cell.camera_position_m.z() - cell.bin.size_m.z();
  EXPECT_NEAR(above_m, 0.5, 1e-9);
  EXPECT_NEAR(cell.camera_position_m.x(), -sensor.baseline_m / 2, 1e-9);
  EXPECT_NEAR(std::atan(-cell.camera_position_m.y() / above_m), 10 * kDegree, 0.1 * kDegree);
}
}  // namespace
}  // namespace ppf_bin_picking

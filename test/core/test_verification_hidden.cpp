#include "ppf_bin_picking/core/verification.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNormalGate_m = 0.005F;

/// A plate of 80 x 60 x 6 mm that looks at the camera, 0.6 m below it.
class HiddenPlate : public ::testing::Test
{
protected:
  PoseEvidence evidenceIn(const std::vector<PlacedMesh>& scene) const
  {
    return gatherEvidence(imageOf(scene, kNormalGate_m), plate_, T_camera_plate_.cast<float>(),
                          DetectorConfig());
  }

  /// A sheet through a point of the plate's upper side, turned about the image's v axis.
  static PlacedMesh sheet(float half_side_m, double tilt_rad, double x_m, double z_m)
  {
    return {squareMesh(half_side_m), poseOf(tilt_rad, {0, 1, 0}, {x_m, 0, z_m})};
  }

  const TriangleMesh mesh_ = boxMesh({0.08F, 0.06F, 0.006F});
  const PpfModel plate_ = coarselyTrained(mesh_);
  const Eigen::Isometry3d T_camera_plate_ = poseOf(M_PI, {1, 0, 0}, {0, 0, 0.603});
};

TEST_F(HiddenPlate, alonePiercesNothing)
{
  const PoseEvidence evidence = evidenceIn({wall(0.8), {mesh_, T_camera_plate_}});
  EXPECT_EQ(evidence.pierced, 0);
  EXPECT_EQ(evidence.stepped, 0);
}

TEST_F(HiddenPlate, seesAStepWhereSomethingLiesBefore)
{
  const PoseEvidence evidence =
      evidenceIn({wall(0.8), {mesh_, T_camera_plate_}, sheet(0.02F, 0, 0.03, 0.57)});
  EXPECT_GT(evidence.occluded, 500);
  EXPECT_GT(evidence.stepped, 50);
  EXPECT_EQ(evidence.pierced, 0);
}

TEST_F(HiddenPlate, seesAStepWhereAWallStandsOnIt)
{
  const TriangleMesh block = boxMesh({0.02F, 0.02F, 0.03F});
  const PoseEvidence evidence = evidenceIn(
      {wall(0.8), {mesh_, T_camera_plate_}, {block, poseOf(0, {1, 0, 0}, {0.015, 0, 0.585})}});
  EXPECT_GT(evidence.stepped, 50);
  EXPECT_LT(evidence.pierced, 0.1 * evidence.stepped);
}

TEST_F(HiddenPlate, isPiercedByASurfaceThatPassesThroughIt)
{
  for (const double tilt_rad : {0.15, 0.3, -0.3})
  {
    const PoseEvidence evidence = evidenceIn({wall(0.8), sheet(0.1F, tilt_rad, 0, 0.6)});
    EXPECT_GT(evidence.occluded, 500) << tilt_rad;
    EXPECT_GT(evidence.pierced, 50) << tilt_rad;
    EXPECT_LT(evidence.stepped, 0.1 * evidence.pierced) << tilt_rad;
  }
}

TEST_F(HiddenPlate, isPiercedInAnImageSoCoarseThatASlopeRisesByAStepFromPixelToPixel)
{
  RangeImage image;
  image.camera = {106, 80, 200, 200, 52.5F, 39.5F};  // 3 mm a pixel, a depth gate is 2 mm
  image.in_roi.assign(static_cast<std::size_t>(image.camera.width) * image.camera.height, 1);
  const auto evidenceIn = [&](const std::vector<PlacedMesh>& scene)
  {
    image.depth = renderDepth(scene, image.camera);
    estimateImageNormals(image, 2, 3 * kNormalGate_m, 1);
    return gatherEvidence(image, plate_, T_camera_plate_.cast<float>(), DetectorConfig());
  };
  const PoseEvidence pierced = evidenceIn({wall(0.8), sheet(0.1F, 0.5, 0, 0.6)});
  EXPECT_GT(pierced.pierced, 15);
  EXPECT_LT(pierced.stepped, 0.1 * pierced.pierced);
  const PoseEvidence covered =
      evidenceIn({wall(0.8), {mesh_, T_camera_plate_}, sheet(0.02F, 0, 0.03, 0.57)});
  EXPECT_GT(covered.stepped, 15);
  EXPECT_EQ(covered.pierced, 0);
}
}  // namespace
}  // namespace ppf_bin_picking

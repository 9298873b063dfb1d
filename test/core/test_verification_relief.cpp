#include "ppf_bin_picking/core/verification.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
/// A plate of 80 x 60 mm with ribs as wide and as far from each other as the normals' window.
TriangleMesh ribbedPlate(float rib_height_m)
{
  std::vector<TriangleMesh> pieces = {boxMesh({0.08F, 0.06F, 0.006F})};
  for (int i = -3; i <= 3; ++i)
    pieces.push_back(shifted(boxMesh({0.005F, 0.06F, rib_height_m}),
                             {0.01F * static_cast<float>(i), 0, 0.003F + rib_height_m / 2}));
  return joined(pieces);
}

/// A ribbed plate that looks at the camera, slanted, far before a wall; measured with plane fits.
class RibbedPlate : public ::testing::Test
{
protected:
  static constexpr float kNormalGate_m = 0.005F;

  RangeImage imageAt(const Eigen::Isometry3d& pose) const
  {
    return imageOf({wall(0.8), {mesh_, pose}}, kNormalGate_m);
  }

  PoseEvidence evidenceAt(const Eigen::Isometry3d& pose, const RangeImage& image) const
  {
    return gatherEvidence(image, plate_, pose.cast<float>(), DetectorConfig());
  }

  const TriangleMesh mesh_ = ribbedPlate(0.0035F);
  const PpfModel plate_ = coarselyTrained(mesh_);
  const Eigen::Isometry3d pose_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6}) * poseOf(0.25, {1, 2, 0}, {0, 0, 0});
};

TEST_F(RibbedPlate, isNotBlamedForNormalsFittedAcrossItsRibs)
{
  const RangeImage image = imageAt(pose_);
  std::size_t smeared = 0;  // surfaces face the camera or stand across; others are of no rib
  for (const Eigen::Vector3f& normal : image.normals)
    smeared += std::abs(normal.z()) > 0.3F && std::abs(normal.z()) < 0.75F ? 1 : 0;
  ASSERT_GT(smeared, 300U) << "the ribs are too coarse for this test";
  const PoseEvidence evidence = evidenceAt(pose_, image);
  EXPECT_LT(evidence.wrong_normal, 0.01 * evidence.expected());
  EXPECT_GT(evidence.support(), 0.98);
}

TEST_F(RibbedPlate, isBlamedForTheNormalsOfAnotherSurface)
{
  RangeImage image = imageAt(pose_);
  for (std::size_t i = 0; i < image.normals.size(); ++i)
    if (image.depth[i] < 0.7F) image.normals[i] = Eigen::Vector3f(0.7F, 0.5F, -0.5F).normalized();
  const TriangleMesh flat = boxMesh({0.08F, 0.06F, 0.006F});
  const PpfModel plate = coarselyTrained(flat);
  const PoseEvidence evidence = gatherEvidence(image, plate, pose_.cast<float>(), DetectorConfig());
  EXPECT_GT(evidence.wrong_normal, 0.3 * evidence.expected());
}
}  // namespace
}  // namespace ppf_bin_picking

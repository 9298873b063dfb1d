#include "ppf_bin_picking/core/verification.hpp"

#include "support/plate_before_wall.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
using SlantedTest = PlateBeforeWall;

/// What a plate that the camera sees at an angle confirms, and what its absence contradicts, per
/// pixel.
struct PerPixel
{
  double confirmed, missing, looked_through;
};

TEST_F(SlantedTest, aSlantedSurfaceCountsLessWhereItIsNotSeenThanWhereItIs)
{
  const auto at_slant = [&](double slant_rad)
  {
    const Eigen::Isometry3d T_camera_plate =
        poseOf(M_PI + slant_rad, {1, 0, 0}, {0, 0, 0.6}) * poseOf(0.1, {0, 0, 1}, {0, 0, 0});
    const auto evidence_of = [&](const RangeImage& image)
    { return gatherEvidence(image, plate_, T_camera_plate.cast<float>(), config_); };
    RangeImage absent = perfectImage({wall(0.8)});
    const PoseEvidence seen = evidence_of(perfectImage({wall(0.8), {mesh_, T_camera_plate}}));
    const PoseEvidence behind = evidence_of(absent);
    std::fill(absent.depth.begin(), absent.depth.end(), 0.0F);
    const PoseEvidence lost = evidence_of(absent);
    return PerPixel{seen.confirmed_weight / seen.visible_px, lost.missing / lost.visible_px,
                    behind.looked_through / behind.visible_px};
  };
  const PerPixel facing = at_slant(0), slanted = at_slant(1.05);  // the cosine is 0.5 there
  EXPECT_NEAR(facing.confirmed, 1, 0.02);
  EXPECT_GT(facing.missing, 0.7) << "in full but for the ring along the outline";
  EXPECT_NEAR(slanted.confirmed / facing.confirmed, 0.71, 0.05);
  EXPECT_NEAR(slanted.missing / facing.missing, 0.33, 0.07);
  EXPECT_NEAR(slanted.looked_through / facing.looked_through, 0.33, 0.07);
}
}  // namespace
}  // namespace ppf_bin_picking

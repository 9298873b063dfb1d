#include "ppf_bin_picking/core/ambiguity.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include "support/plate_before_wall.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ppf_bin_picking
{
namespace
{
class SlideTest : public PlateBeforeWall
{
};

TEST_F(SlideTest, aPlateOnALargerPlaneSlidesAndAFreeOneDoesNot)
{
  const auto slide_share = [&](const RangeImage& image)
  {
    Candidate candidate;
    candidate.T_camera_model = T_camera_plate_.cast<float>();
    candidate.evidence = evidenceIn(image);
    const SelectedPose selected{0, candidate.evidence.confirmed_weight, 0};
    return assessAmbiguity({&plate_}, config_, {candidate}, {selected}, image.depth.size())[0]
        .slide_share;
  };
  // Its upper face lies in a plane that is larger.
  const RangeImage flush =
      perfectImage({{shifted(squareMesh(0.2F), {0, 0, 0.003F}), T_camera_plate_}});
  const PoseEvidence evidence = evidenceIn(flush);
  EXPECT_DOUBLE_EQ(evidence.support(), 1.0) << "it fits perfectly";
  EXPECT_EQ(evidence.outline_held, 0);
  EXPECT_GT(evidence.goes_on.size(), 200U);
  EXPECT_DOUBLE_EQ(slide_share(flush), 1.0);
  EXPECT_DOUBLE_EQ(slide_share(freeImage()), 0.0);

  // A strip as wide as the plate, along x: it slides along the strip alone.
  TriangleMesh strip = shifted(squareMesh(0.2F), {0, 0, 0.003F});
  for (Eigen::Vector3f& vertex : strip.vertices)
    vertex.y() *= 0.03F / 0.2F;
  const PoseEvidence on_strip = evidenceIn(perfectImage({wall(0.8), {strip, T_camera_plate_}}));
  EXPECT_GT(on_strip.outline_held, 120);
  EXPECT_GT(on_strip.goes_on.size(), 80U);
  for (const PoseEvidence::Continuation& continuation : on_strip.goes_on)
  {
    EXPECT_GT(std::abs(continuation.direction.x()), 0.5F);
    const int u = static_cast<int>(continuation.pixel % 320U);
    EXPECT_GT(std::abs(static_cast<float>(u) - 159.5F), 38.0F) << "beyond the plate's end";
    EXPECT_EQ(continuation.direction.x() > 0, u > 160);
  }
}

TEST_F(SlideTest, whereThePartIsAbsentItsOutlineStopsNoSlide)
{
  const PoseEvidence evidence = evidenceIn(perfectImage({wall(0.8)}));
  EXPECT_GT(evidence.outline_broken, 200);
  EXPECT_EQ(evidence.outline_held, 0);
  EXPECT_TRUE(evidence.goes_on.empty());
  EXPECT_EQ(*std::max_element(evidence.slide_held.begin(), evidence.slide_held.end()), 0);
  EXPECT_GT(*std::min_element(evidence.slide_broken.begin(), evidence.slide_broken.end()), 10);
}

TEST(AddSlideStop, weighsBothWaysAcrossAlike)
{
  SlideStops right{}, left{}, diagonal{};
  addSlideStop({1, 0}, right);
  addSlideStop({-1, 0}, left);
  addSlideStop(Eigen::Vector2f(1, 1).normalized(), diagonal);
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    EXPECT_NEAR(right[i], std::pow(std::cos(M_PI * static_cast<double>(i) / 8), 4), 1e-6);
    EXPECT_NEAR(left[i], right[i], 1e-6);
    EXPECT_NEAR(diagonal[(i + 2) % 8], right[i], 1e-6) << "the same, turned";
  }
}
}  // namespace
}  // namespace ppf_bin_picking

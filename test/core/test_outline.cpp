#include "ppf_bin_picking/core/outline.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kJump_m = 0.003F;
constexpr float kGate_m = 0.002F;
constexpr int kReach_px = 8;

RenderedPart rendered(const TriangleMesh& mesh, const Eigen::Isometry3d& T_camera_mesh)
{
  RenderedPart view;
  renderPart(RenderableMesh(mesh), T_camera_mesh.cast<float>(), smallCamera(), view);
  return view;
}

/// Where the camera looks straight at the xy plane of a mesh, its x axis to the right.
Eigen::Isometry3d straightAhead(double z_m)
{
  return poseOf(M_PI, {1, 0, 0}, {0, 0, z_m});
}

TEST(OutlineOf, aBoxHasItOnTheFourSidesOfItsFrontFacePointingOff)
{
  const RenderedPart view = rendered(boxMesh({0.08F, 0.05F, 0.03F}), straightAhead(0.6));
  const float half_u_px = 0.04F / 0.585F * 600, half_v_px = 0.025F / 0.585F * 600;
  const auto outline = outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 1);
  EXPECT_EQ(outline.size(), static_cast<std::size_t>(2 * (view.width + view.height) - 4));
  for (const OutlinePoint& point : outline)
  {
    const Eigen::Vector2f pixel =
        smallCamera().project(point.point) - Eigen::Vector2f(smallCamera().cx, smallCamera().cy);
    EXPECT_NEAR(point.point.z(), 0.585F, 1e-5);
    const float to_u = half_u_px - std::abs(pixel.x()), to_v = half_v_px - std::abs(pixel.y());
    EXPECT_GE(std::min(to_u, to_v), -1e-3F);
    EXPECT_LT(std::min(to_u, to_v), 1.0F);
    EXPECT_NEAR(point.direction.norm(), 1, 1e-5);
    const float corner_px = std::max(to_u, to_v);
    Eigen::Vector2f expected = to_u < to_v ? Eigen::Vector2f(std::copysign(1.0F, pixel.x()), 0)
                                           : Eigen::Vector2f(0, std::copysign(1.0F, pixel.y()));
    if (corner_px < 1)
      expected = Eigen::Vector2f(std::copysign(1.0F, pixel.x()), std::copysign(1.0F, pixel.y()))
                     .normalized();
    EXPECT_GT(point.direction.dot(expected), corner_px < 1 || corner_px > 3 ? 0.999F : 0.8F);
    for (const float depth : point.profile_m)
      EXPECT_NEAR(depth, 0, 1e-5) << "the face lies square to the line of sight";
  }
}

TEST(OutlineOf, takesEverySoManyPixels)
{
  const RenderedPart view = rendered(boxMesh({0.08F, 0.05F, 0.03F}), straightAhead(0.6));
  const auto all = outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 1);
  const auto third = outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 3);
  ASSERT_EQ(third.size(), (all.size() + 2) / 3);
  for (std::size_t i = 0; i < third.size(); ++i)
    EXPECT_EQ(third[i].point, all[3 * i].point);
}

TEST(OutlineOf, aSphereHasItOnItsSilhouetteAlone)
{
  const RenderedPart view = rendered(sphereMesh(0.04F), straightAhead(0.6));
  const auto outline = outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 1);
  // The cone that touches the sphere: sin(angle) = radius / distance.
  const float radius_px = 600 * std::tan(std::asin(0.04F / 0.6F));
  ASSERT_GT(outline.size(), static_cast<std::size_t>(5.5F * radius_px));
  for (const OutlinePoint& point : outline)
  {
    const Eigen::Vector2f pixel =
        smallCamera().project(point.point) - Eigen::Vector2f(smallCamera().cx, smallCamera().cy);
    EXPECT_NEAR(pixel.norm(), radius_px, 1.5F) << "steep as it is there, the surface has no rim";
    EXPECT_GT(point.direction.dot(pixel.normalized()), std::cos(0.35F));
  }
}

TEST(OutlineOf, rimsWithinThePartBelongToItOnTheirUpperSide)
{
  // A post of 20 x 20 mm that stands 15 mm over a plate.
  const TriangleMesh mesh = joined({shifted(boxMesh({0.1F, 0.08F, 0.01F}), {0, 0, -0.005F}),
                                    shifted(boxMesh({0.02F, 0.02F, 0.015F}), {0, 0, 0.0075F})});
  const RenderedPart view = rendered(mesh, straightAhead(0.6));
  const auto within = [](const std::vector<OutlinePoint>& outline)
  {
    std::vector<OutlinePoint> inner;
    std::copy_if(outline.begin(), outline.end(), std::back_inserter(inner),
                 [](const OutlinePoint& p) { return p.point.head<2>().norm() < 0.03F; });
    return inner;
  };
  const auto rim = within(outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 1));
  EXPECT_NEAR(static_cast<double>(rim.size()), 4 * (0.02 / 0.585 * 600 - 1), 4);
  for (const OutlinePoint& point : rim)
  {
    EXPECT_NEAR(point.point.z(), 0.585F, 1e-5) << "the post's edge, not the plate beside it";
    EXPECT_GT(point.direction.dot(point.point.head<2>().normalized()), 0.6F);
    for (std::size_t i = kOutlineReach_px; i < point.profile_m.size(); ++i)
      EXPECT_NEAR(point.profile_m[i], 0, 1e-5) << "the post's face goes on, not the plate";
  }
  EXPECT_TRUE(within(outlineOf(view, smallCamera(), 0.016F, kOutlineReach_px, 1)).empty())
      << "lower than the fall";
}

TEST(OutlineOf, continuesThePlaneOfASlantedFaceBeyondIt)
{
  const Eigen::Isometry3d T_camera_square =
      straightAhead(0.6) * poseOf(0.6, {0.3, 1, 0}, {0, 0, 0});
  const RenderedPart view = rendered(squareMesh(0.04F), T_camera_square);
  const Eigen::Vector3d normal = T_camera_square.linear().col(2);
  const double plane = normal.dot(T_camera_square.translation());
  const auto outline = outlineOf(view, smallCamera(), kJump_m, kOutlineReach_px, 1);
  ASSERT_GT(outline.size(), 200U);
  for (const OutlinePoint& point : outline)
    for (int t = -kOutlineReach_px; t <= kOutlineReach_px; ++t)
    {
      const Eigen::Vector2f start = smallCamera().project(point.point);
      const Eigen::Vector2f offset = static_cast<float>(t) * point.direction;
      const Eigen::Vector3f ray =
          smallCamera().ray(start.x() + std::round(offset.x()), start.y() + std::round(offset.y()));
      EXPECT_NEAR(point.point.z() + point.profile_m[static_cast<std::size_t>(t + kOutlineReach_px)],
                  plane / normal.dot(ray.cast<double>()), 2e-5);
    }
}

TEST(OutlineOf, isEmptyWithoutAPart)
{
  EXPECT_TRUE(outlineOf(RenderedPart(), smallCamera(), kJump_m, kOutlineReach_px, 1).empty());
}

/// An outline point at the middle of an image, and what is measured across it.
class MatchOutline : public ::testing::TestWithParam<int>
{
protected:
  /// @param depth_m  By pixels out of the part; 0: nothing measured.
  OutlineMatch match(const std::function<float(int)>& depth_m, int reach_px = kReach_px) const
  {
    RangeImage image;
    image.camera = {61, 61, 100, 100, 30, 30};
    image.depth.assign(61 * 61, 0);
    for (int v = 0; v < 61; ++v)
      for (int u = 0; u < 61; ++u)
        image.depth[image.index(u, v)] = depth_m(
            static_cast<int>(std::lround(Eigen::Vector2f(u - 30, v - 30).dot(outline_.direction))));
    return matchOutline(image, outline_, outline_.point, kGate_m, reach_px);
  }

  void expect(const std::function<float(int)>& depth_m, OutlineEnd end, int offset_px) const
  {
    const OutlineMatch found = match(depth_m);
    EXPECT_EQ(found.end, end);
    EXPECT_EQ(found.offset_px, offset_px);
  }

  const Eigen::Vector2f direction_ =
      Eigen::Rotation2Df(static_cast<float>(GetParam() * M_PI / 2)) * Eigen::Vector2f::UnitX();
  OutlinePoint outline_{{0, 0, 0.5F}, direction_, {}};
};

TEST_P(MatchOutline, isBehindWhereTheSurfaceEndsBeforeADeeperOne)
{
  for (const int end : {0, 3, -3, 7})
    expect([&](int t) { return t <= end ? 0.5F : 0.6F; }, OutlineEnd::kBehind, end);
}

TEST_P(MatchOutline, isMissingWhereNothingIsMeasuredBeyond)
{
  for (const int end : {0, 4, -5})
    expect([&](int t) { return t <= end ? 0.5F : 0.0F; }, OutlineEnd::kMissing, end);
}

TEST_P(MatchOutline, aLostFlankEndsWhereTheCloudLiesBehindWithinTheOutline)
{
  const auto lost_between = [](int last, int behind) {
    return [=](int t) { return t <= last ? 0.5F : t < behind ? 0.0F : 0.6F; };
  };
  expect(lost_between(-6, -2), OutlineEnd::kBehind, -2);
  expect(lost_between(-3, 0), OutlineEnd::kBehind, 0);
  expect(lost_between(-3, 1), OutlineEnd::kMissing, -3);  // all that was lost may be the part's
  // A hole is no end.
  expect([](int t) { return t == -3 ? 0.0F : t <= 1 ? 0.5F : 0.6F; }, OutlineEnd::kBehind, 1);
}

TEST_P(MatchOutline, goesOnWhereTheSurfaceDoesStraightOrRising)
{
  expect([](int) { return 0.5F; }, OutlineEnd::kGoesOn, kReach_px);
  // A wall that rises from where the part ends, slowly for a step.
  expect([](int t) { return t <= 2 ? 0.5F : 0.5F - 0.0015F * static_cast<float>(t - 2); },
         OutlineEnd::kGoesOn, 3);
}

TEST_P(MatchOutline, onePixelBesideTheEdgeIsNoSurface)
{
  for (int t = 1; t <= kOutlineReach_px; ++t)  // the part's surface falls away there
    outline_.profile_m[static_cast<std::size_t>(t + kOutlineReach_px)] = 1.2F * kGate_m;
  const auto one_goes_on = [](float beyond_m)
  { return [=](int t) { return t <= 1 ? 0.5F : beyond_m; }; };
  expect(one_goes_on(0), OutlineEnd::kMissing, 0);
  expect(one_goes_on(0.6F), OutlineEnd::kBehind, 0);
  expect(one_goes_on(0.4F), OutlineEnd::kHidden, 0);
  expect(one_goes_on(0.5F), OutlineEnd::kGoesOn, 0);
}

TEST_P(MatchOutline, isHiddenWhereSomethingElseLiesInFront)
{
  expect([](int t) { return t <= 2 ? 0.5F : 0.4F; }, OutlineEnd::kHidden, 2);
  expect([](int) { return 0.4F; }, OutlineEnd::kHidden, 0);
  expect([](int t) { return t < -3 ? 0.4F : 0.6F; }, OutlineEnd::kHidden, 0);
}

TEST_P(MatchOutline, isAbsentWhereTheCloudLiesBehindThePart)
{
  expect([](int) { return 0.6F; }, OutlineEnd::kAbsent, -kReach_px);
  expect([](int t) { return t > 2 ? 0.0F : 0.6F; }, OutlineEnd::kAbsent, -kReach_px);
  // What begins beyond the outline is not the part's.
  expect([](int t) { return t > 0 ? 0.5F : 0.6F; }, OutlineEnd::kAbsent, -kReach_px);
}

TEST_P(MatchOutline, isHiddenWhereTooLittleIsMeasuredToTell)
{
  expect([](int) { return 0.0F; }, OutlineEnd::kHidden, 0);
  expect([](int t) { return t > 0 ? 0.6F : 0.0F; }, OutlineEnd::kHidden, 0);
}

TEST_P(MatchOutline, followsASurfaceWithinTheGateOfTheProfile)
{
  for (int t = -kOutlineReach_px; t <= kOutlineReach_px; ++t)
    outline_.profile_m[static_cast<std::size_t>(t + kOutlineReach_px)] =
        0.01F * static_cast<float>(t);
  const auto slope = [](int t) { return 0.5F + 0.01F * static_cast<float>(t); };
  expect([&](int t) { return slope(t) + (t % 2 == 0 ? 0.9F : -0.9F) * kGate_m; },
         OutlineEnd::kGoesOn, kReach_px);
  expect([&](int t) { return slope(t) + (t > 1 ? 1.1F * kGate_m : 0.0F); }, OutlineEnd::kBehind, 1);
}

TEST_P(MatchOutline, looksNoFartherThanToldTo)
{
  const auto ends_late = [](int t) { return t <= 4 ? 0.5F : 0.6F; };
  EXPECT_EQ(match(ends_late, 3).end, OutlineEnd::kGoesOn);
  EXPECT_EQ(match(ends_late, 5).end, OutlineEnd::kBehind);
}

TEST_P(MatchOutline, isHiddenBehindTheCameraAndBeyondTheImage)
{
  outline_.point = {0, 0, -0.5F};
  expect([](int) { return 0.5F; }, OutlineEnd::kHidden, 0);
  outline_.point = {0.5F * 26 / 100 * direction_.x(), 0.5F * 26 / 100 * direction_.y(), 0.5F};
  expect([](int) { return 0.5F; }, OutlineEnd::kHidden, 0);  // 4 pixels to the border
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, MatchOutline, ::testing::Range(0, 4));
}  // namespace
}  // namespace ppf_bin_picking

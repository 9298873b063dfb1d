#include "ppf_bin_picking/core/surface_discrepancy.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDelta_m = 0.005;
const PinholeCamera kCamera = {64, 48, 60, 60, 31.5F, 23.5F};
const std::vector<double> kTolerances_m = {0.01, 0.02, 0.05};

RenderedPart rendered(const TriangleMesh& mesh, const Eigen::Isometry3f& pose)
{
  RenderedPart part;
  renderPart(RenderableMesh(mesh), pose, kCamera, part);
  return part;
}

Eigen::Isometry3f at(float x, float y, float z)
{
  return Eigen::Isometry3f(Eigen::Translation3f(x, y, z));
}

/// The part in a whole image.
std::vector<float> imageOf(const RenderedPart& part)
{
  std::vector<float> image(static_cast<std::size_t>(kCamera.width) * kCamera.height, 0.0F);
  for (int row = 0; row < part.height; ++row)
    for (int column = 0; column < part.width; ++column)
      image[static_cast<std::size_t>(part.top + row) * kCamera.width + part.left + column] =
          part.depthAt(column, row);
  return image;
}

/// The definition, with whole images and masks.
double slowDiscrepancy(const RenderedPart& found, const RenderedPart& truth,
                       const std::vector<float>& measured, double tolerance_m)
{
  const std::vector<float> image_found = imageOf(found);
  const std::vector<float> image_truth = imageOf(truth);
  double pixels = 0;
  double wrong = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
  {
    const float u = static_cast<float>(i % static_cast<std::size_t>(kCamera.width));
    const float v = static_cast<float>(i / static_cast<std::size_t>(kCamera.width));
    const double length = kCamera.ray(u, v).cast<double>().norm();
    const double distance_found = image_found[i] * length;
    const double distance_truth = image_truth[i] * length;
    const double distance = measured[i] * length;
    const bool mask_truth =
        image_truth[i] > 0 && (measured[i] == 0 || distance_truth - distance <= kDelta_m);
    const bool mask_found =
        image_found[i] > 0 &&
        (measured[i] == 0 || distance_found - distance <= kDelta_m || mask_truth);
    if (!mask_truth && !mask_found) continue;
    ++pixels;
    if (!(mask_truth && mask_found && std::abs(distance_found - distance_truth) < tolerance_m))
      ++wrong;
  }
  return pixels == 0 ? 1 : wrong / pixels;
}

std::vector<double> discrepancy(const RenderedPart& found, const RenderedPart& truth,
                                const std::vector<float>& measured)
{
  return visibleSurfaceDiscrepancy(found, truth, kCamera, measured, kDelta_m, kTolerances_m);
}

TEST(SurfaceDiscrepancy, ofTheTruePoseIsZero)
{
  const RenderedPart truth = rendered(angleMesh(), at(0, 0, 0.2F));
  for (const double error : discrepancy(truth, truth, imageOf(truth)))
    EXPECT_EQ(error, 0);
}

TEST(SurfaceDiscrepancy, ofADepthErrorDependsOnTheTolerance)
{
  // 6 m away the rays are almost parallel: the square covers the same 20 x 20 pixels 15 mm nearer.
  const RenderedPart truth = rendered(squareMesh(1), at(0, 0, 6));
  const RenderedPart found = rendered(squareMesh(1), at(0, 0, 5.985F));
  EXPECT_EQ(discrepancy(found, truth, imageOf(truth)), (std::vector<double>{1, 0, 0}));
}

TEST(SurfaceDiscrepancy, ofAShiftIsTheShareOfPixelsOfOneAlone)
{
  const RenderedPart truth = rendered(squareMesh(1), at(0, 0, 6));
  ASSERT_EQ(truth.width, 20);
  const RenderedPart found = rendered(squareMesh(1), at(1, 0, 6));  // 10 of 20 columns
  for (const double error : discrepancy(found, truth, imageOf(truth)))
    EXPECT_NEAR(error, 20.0 / 30.0, 1e-12);
  const RenderedPart beside = rendered(squareMesh(1), at(2.1F, 0, 6));
  EXPECT_EQ(discrepancy(beside, truth, imageOf(truth)), (std::vector<double>{1, 1, 1}));
}

TEST(SurfaceDiscrepancy, countsWhatIsVisible)
{
  const RenderedPart truth = rendered(squareMesh(1), at(0, 0, 6));
  const RenderedPart found = rendered(squareMesh(1), at(1, 0, 6));
  // Something nearer covers all columns but the last ten of the truth.
  std::vector<float> measured(imageOf(truth).size(), 0.0F);
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i] = i % 64 < 32 || i % 64 >= 42 ? 3.0F : 6.0F;
  EXPECT_EQ(discrepancy(found, truth, measured), (std::vector<double>{0, 0, 0}));
  // All of it is covered.
  measured.assign(measured.size(), 3.0F);
  EXPECT_EQ(discrepancy(truth, truth, measured), (std::vector<double>{1, 1, 1}));
  // Without a measurement it is visible.
  measured.assign(measured.size(), 0.0F);
  EXPECT_EQ(discrepancy(truth, truth, measured), (std::vector<double>{0, 0, 0}));
}

TEST(SurfaceDiscrepancy, seesTheFoundPartWhereTheTrueOneIsVisible)
{
  // The found pose lies 15 mm behind the measured surface, which is that of the true one.
  const RenderedPart truth = rendered(squareMesh(1), at(0, 0, 6));
  const RenderedPart found = rendered(squareMesh(1), at(0, 0, 6.015F));
  EXPECT_EQ(discrepancy(found, truth, imageOf(truth))[1], 0);
}

TEST(SurfaceDiscrepancy, isThatOfItsDefinition)
{
  std::mt19937 rng(5);
  std::normal_distribution<float> normal;
  const auto random_pose = [&]
  {
    const Eigen::Quaternionf turn(normal(rng), normal(rng), normal(rng), normal(rng));
    Eigen::Isometry3f pose = at(0.02F * normal(rng), 0.02F * normal(rng), 0.15F);
    pose.linear() = turn.normalized().toRotationMatrix();
    return pose;
  };
  for (int trial = 0; trial < 100; ++trial)
  {
    SCOPED_TRACE(trial);
    const RenderedPart truth = rendered(angleMesh(), random_pose());
    const RenderedPart found = rendered(angleMesh(), random_pose());
    std::vector<float> measured = imageOf(truth);
    for (float& z : measured)
      z = std::max(0.0F, z == 0 ? 0.15F + 0.02F * normal(rng) : z + 0.005F * normal(rng));
    const std::vector<double> errors = discrepancy(found, truth, measured);
    for (std::size_t i = 0; i < kTolerances_m.size(); ++i)
      EXPECT_NEAR(errors[i], slowDiscrepancy(found, truth, measured, kTolerances_m[i]), 1e-12);
  }
}

TEST(SurfaceDiscrepancy, refusesAnImageOfAnotherSize)
{
  const RenderedPart truth = rendered(squareMesh(1), at(0, 0, 6));
  EXPECT_THROW(discrepancy(truth, truth, {0.5F}), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking

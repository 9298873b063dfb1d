#include "ppf_bin_picking/core/depth_noise.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNormalGate_m = 0.004F;

/// A bracket and a lying pin before a slanted wall: planes, edges and a curved surface.
RangeImage sceneWithNoise(float noise_m)
{
  return imageOf({{squareMesh(0.6F),
                   poseOf(M_PI, {1, 0, 0}, {0, 0, 0.7}) * poseOf(0.4, {1, 0.3, 0}, {0, 0, 0})},
                  {bracketMesh(), poseOf(0.5, {1, 0, 0}, {-0.04, 0, 0.6})},
                  {cylinderMesh(0.02F, 0.08F, 64), poseOf(1.2, {1, 1, 0}, {0.05, 0.02, 0.6})}},
                 kNormalGate_m, noise_m, 5);
}

TEST(DepthNoise, isThatOfTheDepthWhateverTheShapes)
{
  EXPECT_LT(depthNoise(sceneWithNoise(0)), 2e-6);
  for (const float noise_m : {0.0001F, 0.0005F, 0.002F})
  {
    SCOPED_TRACE(noise_m);
    EXPECT_NEAR(depthNoise(sceneWithNoise(noise_m)), noise_m, 0.1 * noise_m);
  }
}

TEST(DepthNoise, looksOnlyAtTheRegionAndAtWhatIsMeasured)
{
  RangeImage image = sceneWithNoise(0.0005F);
  const double everywhere_m = depthNoise(image);
  for (std::size_t i = 0; i < image.depth.size(); ++i)
    if (i % 29 == 0) image.depth[i] = 0;
  EXPECT_NEAR(depthNoise(image), everywhere_m, 0.2 * everywhere_m);
  image = sceneWithNoise(0.0005F);
  const RangeImage still = sceneWithNoise(0);
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      const std::size_t i = image.index(u, v);
      image.in_roi[i] = u < image.camera.width / 2 ? 1 : 0;
      if (u <= image.camera.width / 2) image.depth[i] = still.depth[i];
    }
  EXPECT_LT(depthNoise(image), 2e-6);
}

TEST(DepthNoise, isNoneWhereTooLittleIsMeasured)
{
  RangeImage image = sceneWithNoise(0.0005F);
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
      if (u >= 12 || v >= 12) image.depth[image.index(u, v)] = 0;
  EXPECT_EQ(depthNoise(image), 0);
  EXPECT_EQ(depthNoise(RangeImage()), 0);
}

TEST(DepthGate, followsTheNoiseWhereThatIsMoreThanThePartsGate)
{
  DetectorConfig config;
  config.depth_gate_rel = 0.02;
  RangeImage image;
  EXPECT_DOUBLE_EQ(depthGate(image, 0.1, config), 0.002);
  image.noise_m = 0.0007;
  EXPECT_DOUBLE_EQ(depthGate(image, 0.1, config), 0.002);
  image.noise_m = 0.0012;
  EXPECT_DOUBLE_EQ(depthGate(image, 0.1, config), 0.003);
  image.noise_m = 1;
  EXPECT_DOUBLE_EQ(depthGate(image, 0.1, config), 0.005);
  config.depth_gate_rel = 0.06;
  EXPECT_DOUBLE_EQ(depthGate(image, 0.1, config), 0.006);
}

TEST(RangeImageNoise, widensTheWindowsOfTheNormals)
{
  RangeImageOptions options;
  options.diameter_m = options.largest_diameter_m = 0.1;
  const auto image_of = [&](float noise_m)
  {
    const PointCloud cloud = renderCloud({{squareMesh(0.6F), poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6})}},
                                         smallCamera(), noise_m);
    return makeRangeImage(cloud, std::nullopt, options).image;
  };
  const auto mean_turn_rad = [](const RangeImage& image)
  {
    double sum = 0;
    std::size_t known = 0;
    for (const Eigen::Vector3f& normal : image.normals)
      if (!normal.isZero()) sum += 1 + normal.z(), ++known;
    return std::sqrt(2 * sum / static_cast<double>(known));  // root of the mean square
  };
  const RangeImage still = image_of(0.0001F);
  EXPECT_EQ(still.normal_radius_px, options.normal_radius_px);
  const double pixel_m = 0.6 / still.camera.fx;
  const RangeImage noisy = image_of(static_cast<float>(2 * pixel_m));
  EXPECT_NEAR(noisy.noise_m, 2 * pixel_m, 0.2 * pixel_m);
  EXPECT_EQ(noisy.normal_radius_px, 3);
  EXPECT_LT(mean_turn_rad(noisy), 0.25);
  options.normal_radius_px = 7;
  EXPECT_EQ(image_of(static_cast<float>(2 * pixel_m)).normal_radius_px, 7);
  PointCloud loose =
      renderCloud({{squareMesh(0.6F), poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6})}}, smallCamera());
  loose.width = loose.height = 0;
  EXPECT_EQ(makeRangeImage(loose, std::nullopt, options).image.normal_radius_px, 7);
}
}  // namespace
}  // namespace ppf_bin_picking

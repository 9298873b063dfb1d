#include "ppf_bin_picking/core/range_image.hpp"

#include "support/depth_clouds.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Averages blocks of factor x factor pixels.
RangeImageOptions everyBlock(const PinholeCamera& camera, int factor)
{
  RangeImageOptions options = everyPixel(camera);
  options.pixels_per_diameter /= factor;
  return options;
}

TEST(EstimateCamera, isExactForTheCloudsOfAnyCameraWithHoles)
{
  std::mt19937 rng(2);
  std::uniform_real_distribution<float> uniform;
  for (int trial = 0; trial < 20; ++trial)
  {
    SCOPED_TRACE(trial);
    const PinholeCamera camera{200 + static_cast<int>(rng() % 200),
                               150 + static_cast<int>(rng() % 150),
                               300 + 900 * uniform(rng),
                               300 + 900 * uniform(rng),
                               300 * uniform(rng) - 50,
                               300 * uniform(rng) - 50};
    const PointCloud cloud = cloudOf(
        camera,
        [&](int u, int v) {
          return rng() % 3 == 0 ? 0.0 : 0.8 + 0.1 * std::sin(0.1 * u) + 0.1 * std::cos(0.07 * v);
        });
    const auto found = estimateCamera(cloud);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->width, camera.width);
    EXPECT_EQ(found->height, camera.height);
    EXPECT_NEAR(found->fx, camera.fx, 1e-4 * camera.fx);
    EXPECT_NEAR(found->fy, camera.fy, 1e-4 * camera.fy);
    EXPECT_NEAR(found->cx, camera.cx, 0.01);
    EXPECT_NEAR(found->cy, camera.cy, 0.01);
  }
}

TEST(EstimateCamera, findsNoneWhereThereIsNone)
{
  const PinholeCamera camera = smallCamera();
  const auto flat = [](int, int) { return 0.6; };
  EXPECT_FALSE(estimateCamera(PointCloud()));
  EXPECT_FALSE(estimateCamera(shuffledCloud(cloudOf(camera, flat)))) << "not organised";
  EXPECT_FALSE(estimateCamera(cloudOf(camera, [](int, int) { return 0.0; }))) << "nothing measured";
  EXPECT_FALSE(estimateCamera(cloudOf(camera, [](int u, int) { return u == 7 ? 0.6 : 0.0; })))
      << "one column";
  PointCloud mirrored = cloudOf(camera, flat);
  for (Eigen::Vector3f& p : mirrored.points)
    p.x() = -p.x();
  EXPECT_FALSE(estimateCamera(mirrored)) << "x grows to the left";

  // Columns bent by up to this many pixels leave residuals of up to half of it and a bit.
  const auto bent = [&](double bend_px)
  {
    PointCloud cloud = cloudOf(camera, flat);
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      const double across = (static_cast<double>(i % cloud.width) - camera.cx) / camera.cx;
      cloud.points[i].x() += static_cast<float>(0.6 / camera.fx * bend_px * across * across);
    }
    return cloud;
  };
  EXPECT_TRUE(estimateCamera(bent(0.5)));
  EXPECT_FALSE(estimateCamera(bent(1.0)));
}

TEST(MakeRangeImage, keepsThePixelsOfAnOrganisedCloud)
{
  const PinholeCamera camera = smallCamera();
  std::mt19937 rng(4);
  const PointCloud cloud =
      cloudOf(camera, [&](int u, int v)
              { return rng() % 5 == 0 ? 0.0 : 0.55 + 0.0002 * u + 0.02 * std::sin(0.05 * v); });
  const RangeImageResult result = makeRangeImage(cloud, std::nullopt, everyPixel(camera));
  const RangeImage& image = result.image;
  ASSERT_EQ(image.camera.width, camera.width);
  ASSERT_EQ(image.camera.height, camera.height);
  std::size_t measured = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const bool finite = cloud.points[i].allFinite();
    measured += finite ? 1 : 0;
    ASSERT_EQ(image.depth[i], finite ? cloud.points[i].z() : 0.0F);
    ASSERT_EQ(image.in_roi[i], finite ? 1 : 0);
    if (!finite) continue;
    const int u = static_cast<int>(i % cloud.width), v = static_cast<int>(i / cloud.width);
    ASSERT_LT((image.point(u, v) - cloud.points[i]).norm(), 2e-6F);
  }
  EXPECT_EQ(result.roi_points, measured);
}

TEST(MakeRangeImage, marksThePixelsInATurnedRegionAndReachesAroundIt)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud cloud =
      cloudOf(camera, [&](int u, int v) { return slantedDepth(camera, u, v); });
  RegionOfInterest roi;
  roi.T_cloud_box = poseOf(0.5, {0.2, 0.1, 1}, {0.01, 0.01, 0.61});
  roi.min = {-0.03, -0.02, -0.01};
  roi.max = {0.03, 0.025, 0.02};
  const RangeImageOptions options = everyPixel(camera);
  const RangeImageResult result = makeRangeImage(cloud, roi, options);
  const RangeImage& image = result.image;
  const int left = static_cast<int>(std::lround(camera.cx - image.camera.cx));
  const int top = static_cast<int>(std::lround(camera.cy - image.camera.cy));
  std::size_t inside = 0;
  int first_column = camera.width, last_column = -1;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
    {
      const std::size_t i = static_cast<std::size_t>(v) * cloud.width + static_cast<std::size_t>(u);
      if (!roi.contains(cloud.points[i])) continue;
      ++inside;
      first_column = std::min(first_column, u);
      last_column = std::max(last_column, u);
      ASSERT_TRUE(u >= left && v >= top && u < left + image.camera.width &&
                  v < top + image.camera.height);
    }
  std::size_t marked = 0;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      const std::size_t i =
          static_cast<std::size_t>(v + top) * cloud.width + static_cast<std::size_t>(u + left);
      ASSERT_EQ(image.in_roi[image.index(u, v)], roi.contains(cloud.points[i]) ? 1 : 0);
      ASSERT_EQ(image.depth[image.index(u, v)], cloud.points[i].z());
      marked += image.in_roi[image.index(u, v)];
    }
  ASSERT_GT(inside, 1000U);
  EXPECT_EQ(marked, inside);
  EXPECT_EQ(result.roi_points, inside);
  // A part half of which lies outside the region must fit into the image.
  const double half_part_px = 0.5 * options.largest_diameter_m * camera.fx / 0.65;
  EXPECT_LE(left, first_column - half_part_px);
  EXPECT_GE(left + image.camera.width - 1, last_column + half_part_px);
  EXPECT_LT(image.camera.width, camera.width);
}

TEST(MakeRangeImage, isEmptyWhereTheRegionIs)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud cloud = cloudOf(camera, [](int, int) { return 0.6; });
  RegionOfInterest roi;
  roi.min = {-0.1, -0.1, 0.7};
  roi.max = {0.1, 0.1, 0.8};
  for (const PointCloud& given : {cloud, shuffledCloud(cloud), PointCloud()})
  {
    const RangeImageResult result = makeRangeImage(given, roi, everyPixel(camera));
    EXPECT_EQ(result.roi_points, 0U);
    EXPECT_TRUE(result.image.depth.empty());
  }
}

TEST(MakeRangeImage, averagedDownKeepsAPlane)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud cloud =
      cloudOf(camera, [&](int u, int v) { return slantedDepth(camera, u, v, 0.4, -0.2); });
  for (const int factor : {2, 3, 4})
  {
    SCOPED_TRACE(factor);
    const RangeImage image = makeRangeImage(cloud, std::nullopt, everyBlock(camera, factor)).image;
    ASSERT_EQ(image.camera.width, camera.width / factor);
    ASSERT_EQ(image.camera.height, camera.height / factor);
    EXPECT_NEAR(image.camera.fx, camera.fx / static_cast<float>(factor), 0.05);
    const Eigen::Vector3f normal = Eigen::Vector3f(0.4F, -0.2F, -1).normalized();
    for (int v = 0; v < image.camera.height; ++v)
      for (int u = 0; u < image.camera.width; ++u)
      {
        const Eigen::Vector3f p = image.point(u, v);
        ASSERT_NEAR((p - Eigen::Vector3f(0, 0, 0.6F)).dot(normal), 0, 1e-5);
        ASSERT_GT(image.normals[image.index(u, v)].dot(normal), std::cos(0.005F));
      }
  }
}

TEST(MakeRangeImage, averagesNoiseAway)
{
  const PinholeCamera camera = smallCamera();
  constexpr double kNoise_m = 0.0003;
  std::mt19937 rng(6);
  std::normal_distribution<double> noise(0, kNoise_m);
  const PointCloud cloud = cloudOf(camera, [&](int, int) { return 0.6 + noise(rng); });
  const RangeImage image = makeRangeImage(cloud, std::nullopt, everyBlock(camera, 4)).image;
  double squares = 0;
  for (const float z : image.depth)
    squares += (z - 0.6) * (z - 0.6);
  const double deviation_m = std::sqrt(squares / static_cast<double>(image.depth.size()));
  EXPECT_LT(deviation_m, 1.5 * kNoise_m / 4);
}

TEST(MakeRangeImage, takesOfABlockTheSurfaceOfItsMedianAlone)
{
  const PinholeCamera camera = smallCamera();
  // Edges that cross the blocks of 3 x 3 pixels anywhere.
  const auto is_near = [](int u, int v) { return (u + v / 2) % 23 < 11; };
  const auto depth = [&](int u, int v) { return is_near(u, v) ? 0.58 : 0.6; };
  const PointCloud cloud = cloudOf(camera, depth);
  RegionOfInterest roi;  // the near surface alone
  roi.min = {-1, -1, 0.5};
  roi.max = {1, 1, 0.59};
  RangeImageOptions options = everyBlock(camera, 3);
  options.largest_diameter_m = 1;  // the whole image
  options.pixels_per_diameter *= 0.6 / 0.58;
  const RangeImage image = makeRangeImage(cloud, roi, options).image;
  ASSERT_EQ(image.camera.width, camera.width / 3);
  int mixed_blocks = 0;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      int near = 0;
      for (int k = 0; k < 9; ++k)
        near += is_near(3 * u + k % 3, 3 * v + k / 3) ? 1 : 0;
      mixed_blocks += near > 0 && near < 9 ? 1 : 0;
      ASSERT_NEAR(image.depth[image.index(u, v)], near >= 5 ? 0.58 : 0.6, 1e-6);
      ASSERT_EQ(image.in_roi[image.index(u, v)], near >= 5 ? 1 : 0);
    }
  EXPECT_GT(mixed_blocks, 500);
}

TEST(MakeRangeImage, takesTheCloudsNormalsIfToldTo)
{
  const PinholeCamera camera = smallCamera();
  PointCloud cloud = cloudOf(camera, [](int, int) { return 0.6; });
  const Eigen::Vector3f given =
      Eigen::Vector3f(0.5F, 0.2F, 1).normalized();  // away from the camera
  cloud.normals.assign(cloud.size(), 3.0F * given);
  cloud.normals[1000] = {kNan, 0, 0};
  cloud.normals[1001] = {0, 0, 0};
  RangeImageOptions options = everyPixel(camera);
  for (const PointCloud& one : {cloud, [&]
                                {
                                  PointCloud turned = cloud;
                                  for (Eigen::Vector3f& normal : turned.normals)
                                    normal = -normal;
                                  return turned;
                                }()})
  {
    options.use_cloud_normals = true;
    const RangeImage image = makeRangeImage(one, std::nullopt, options).image;
    ASSERT_EQ(image.normals.size(), cloud.size());
    for (std::size_t i = 0; i < image.normals.size(); ++i)
    {
      const bool none = i == 1000 || i == 1001;
      ASSERT_LT((image.normals[i] + (none ? 0.0F : 1.0F) * given).norm(), 1e-5F) << i;
    }
    options.use_cloud_normals = false;
    EXPECT_LT(makeRangeImage(one, std::nullopt, options).image.normals[5000].z(), -0.999F);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/range_image.hpp"

#include "support/depth_clouds.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>

namespace ppf_bin_picking
{
namespace
{
/// A wavy surface with a hole.
PointCloud wavyCloud(const PinholeCamera& camera)
{
  return cloudOf(camera,
                 [&](int u, int v)
                 {
                   const bool hole = std::abs(u - 100) < 12 && std::abs(v - 100) < 12;
                   return hole ? 0.0 : slantedDepth(camera, u, v, 0.4) + 0.004 * std::sin(0.1 * u);
                 });
}

TEST(MakeRangeImageUnorganised, showsEveryPointOfAnUnorganisedCloudWithinAPixel)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud cloud = shuffledCloud(wavyCloud(camera));
  const RangeImageResult result = makeRangeImage(cloud, std::nullopt, everyPixel(camera));
  const RangeImage& image = result.image;
  EXPECT_EQ(result.roi_points, cloud.size());
  EXPECT_NEAR(image.camera.fx, camera.fx, 0.3 * camera.fx) << "a pixel is as large as the spacing";
  for (const Eigen::Vector3f& p : cloud.points)
  {
    int u = 0, v = 0;
    ASSERT_TRUE(image.camera.pixelOf(p, u, v));
    const float z = image.depth[image.index(u, v)];
    ASSERT_GT(z, 0);
    ASSERT_LE(z, p.z());
    ASSERT_LT((image.point(u, v) - p).norm(), 0.003F) << "the slope over a pixel at most";
  }
  // Where nothing was measured nothing is shown, but for single missing pixels.
  int u = 0, v = 0;
  const Eigen::Vector3f in_hole = camera.ray(100, 100) * 0.6F;
  ASSERT_TRUE(image.camera.pixelOf(in_hole, u, v));
  EXPECT_EQ(image.depth[image.index(u, v)], 0);
}

TEST(MakeRangeImageUnorganised, fillsSinglePixelsThatNoPointFellInto)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud whole = cloudOf(camera, [](int, int) { return 0.6; });
  PointCloud sparse;  // one point in nine is missing
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (i % whole.width % 3 != 1 || i / whole.width % 3 != 1)
      sparse.points.push_back(whole.points[i]);
  sparse.width = sparse.points.size();
  sparse.height = 1;
  const RangeImage image = makeRangeImage(sparse, std::nullopt, everyPixel(camera)).image;
  for (const Eigen::Vector3f& p : whole.points)
  {
    int u = 0, v = 0;
    ASSERT_TRUE(image.camera.pixelOf(p, u, v));
    if (std::abs(p.x()) > 0.15F || std::abs(p.y()) > 0.11F) continue;
    ASSERT_NEAR(image.depth[image.index(u, v)], 0.6, 1e-6);
    ASSERT_EQ(image.in_roi[image.index(u, v)], 1);
  }
}

TEST(MakeRangeImageUnorganised, drawsTheNearestOfTwoPoints)
{
  const PinholeCamera camera = smallCamera();
  PointCloud cloud = shuffledCloud(cloudOf(camera, [](int, int) { return 0.6; }));
  const PointCloud near = shuffledCloud(
      cloudOf(camera, [](int u, int v) { return std::hypot(u - 150, v - 100) < 40 ? 0.5 : 0.0; }));
  cloud.points.insert(cloud.points.begin() + 100, near.points.begin(), near.points.end());
  cloud.width = cloud.points.size();
  const RangeImage image = makeRangeImage(cloud, std::nullopt, everyPixel(camera)).image;
  for (const Eigen::Vector3f& p : near.points)
  {
    int u = 0, v = 0;
    ASSERT_TRUE(image.camera.pixelOf(p, u, v));
    ASSERT_NEAR(image.depth[image.index(u, v)], 0.5, 1e-6);
  }
}

TEST(MakeRangeImageUnorganised, doesNotDependOnTheOrderOfDensePoints)
{
  const PinholeCamera camera = smallCamera();
  RangeImageOptions options = everyPixel(camera);
  options.pixels_per_diameter /= 2;  // the part asks for coarser pixels than the points lie
  PointCloud cloud = shuffledCloud(wavyCloud(camera));
  RegionOfInterest roi;
  roi.min = {-0.08, -0.06, 0.5};
  roi.max = {0.07, 0.05, 0.7};
  const RangeImageResult one = makeRangeImage(cloud, roi, options);
  std::shuffle(cloud.points.begin(), cloud.points.end(), std::mt19937(77));
  options.threads = 3;
  const RangeImageResult other = makeRangeImage(cloud, roi, options);
  EXPECT_EQ(one.roi_points, other.roi_points);
  EXPECT_EQ(one.image.depth, other.image.depth);
  EXPECT_EQ(one.image.in_roi, other.image.in_roi);
  EXPECT_EQ(one.image.normals, other.image.normals);
  ASSERT_GT(one.image.depth.size(), 5000U);
}

TEST(MakeRangeImageUnorganised, givesTheSamePixelsToSparsePointsInAnyOrder)
{
  const PinholeCamera camera = smallCamera();
  RangeImageOptions options = everyPixel(camera);
  options.pixels_per_diameter *= 4;  // finer than the points lie: their spacing decides
  PointCloud cloud = shuffledCloud(wavyCloud(camera));
  std::mt19937 random(78);
  std::normal_distribution<float> noise(0, 0.0001F);
  for (Eigen::Vector3f& point : cloud.points)
    point += Eigen::Vector3f(noise(random), noise(random), noise(random));
  const RangeImageResult one = makeRangeImage(cloud, std::nullopt, options);
  std::shuffle(cloud.points.begin(), cloud.points.end(), random);
  const RangeImageResult other = makeRangeImage(cloud, std::nullopt, options);
  EXPECT_EQ(one.image.camera.fx, other.image.camera.fx);
  EXPECT_EQ(one.image.depth, other.image.depth);
  EXPECT_LT(one.image.camera.fx, 0.9F * 4 * camera.fx);
}

TEST(MakeRangeImageUnorganised, seesTheSameSurfaceOrganisedOrNot)
{
  const PinholeCamera camera = smallCamera();
  const PointCloud cloud = wavyCloud(camera);
  const RangeImage organised = makeRangeImage(cloud, std::nullopt, everyPixel(camera)).image;
  RangeImageOptions coarser = everyPixel(camera);  // than the spacing, so that no pixel is empty
  coarser.pixels_per_diameter *= 0.85;
  const RangeImage loose = makeRangeImage(shuffledCloud(cloud), std::nullopt, coarser).image;
  int compared = 0, turned = 0;
  for (int v = 5; v < camera.height - 5; v += 3)
    for (int u = 5; u < camera.width - 5; u += 3)
    {
      if (std::abs(u - 100) < 18 && std::abs(v - 100) < 18) continue;
      int u_loose = 0, v_loose = 0;
      ASSERT_TRUE(loose.camera.pixelOf(organised.point(u, v), u_loose, v_loose));
      const Eigen::Vector3f& normal = loose.normals[loose.index(u_loose, v_loose)];
      ASSERT_NEAR(normal.norm(), 1, 1e-4);
      ++compared;
      turned += normal.dot(organised.normals[organised.index(u, v)]) < std::cos(0.15F) ? 1 : 0;
    }
  EXPECT_GT(compared, 5000);
  EXPECT_LT(turned, 0.01 * compared);
}
}  // namespace
}  // namespace ppf_bin_picking

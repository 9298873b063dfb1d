#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/normals.hpp"

#include "range_image_makers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kSpacingSamples = 10000;  // points whose neighbours give the spacing, about
constexpr float kPixelPerSpacing = 1.0F;        // the image is about as fine as the points lie
constexpr int kMaxImageSide_px = 4000;
constexpr int kPointNeighbors = 12;

/// A number that a point's coordinates alone decide, whatever its place in the cloud.
std::size_t hashOf(const Eigen::Vector3f& p)
{
  const std::hash<float> hash;
  constexpr std::size_t kOdd = 0x9E3779B97F4A7C15;  // spreads the bits, as in Knuth's hashing
  return (((hash(p.x()) * kOdd) ^ hash(p.y())) * kOdd ^ hash(p.z())) * kOdd >> 32;
}

/// Angle between neighbouring points as seen from the camera: the median over some of them, which
/// are the same in whatever order the points come [rad].
float pointSpacing(const std::vector<Eigen::Vector3f>& points)
{
  const NeighborSearch search(points);
  std::vector<float> spacings;
  std::vector<std::pair<std::uint32_t, float>> near;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSpacingSamples);
  for (const Eigen::Vector3f& point : points)
  {
    if (hashOf(point) % stride != 0) continue;
    search.nearest(point, 2, near);
    if (near.size() == 2) spacings.push_back(std::sqrt(near[1].second) / point.z());
  }
  if (spacings.empty()) return 0;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

/// The part of a coordinate's values that matters: without the outermost thousandth at either end,
/// which may be stray points.
std::pair<float, float> extentOf(std::vector<float>& values)
{
  return {percentile(values, 0.001), percentile(values, 0.999)};
}

/// A camera at the origin that sees the points but for stray ones, and a margin around them, in
/// pixels of a given angle.
PinholeCamera cameraAround(const std::vector<Eigen::Vector3f>& points, float pixel_rad,
                           float margin_rad)
{
  std::vector<float> slopes_x, slopes_y;
  for (const Eigen::Vector3f& p : points)
  {
    slopes_x.push_back(p.x() / p.z());
    slopes_y.push_back(p.y() / p.z());
  }
  auto [left, right] = extentOf(slopes_x);
  auto [top, bottom] = extentOf(slopes_y);
  left -= margin_rad, right += margin_rad, top -= margin_rad, bottom += margin_rad;
  const float side_rad = std::max(right - left, bottom - top);
  pixel_rad = std::max(pixel_rad, side_rad / static_cast<float>(kMaxImageSide_px));
  PinholeCamera camera;
  camera.fx = camera.fy = 1 / pixel_rad;
  camera.cx = 1 - left * camera.fx;
  camera.cy = 1 - top * camera.fy;
  camera.width = static_cast<int>((right - left) * camera.fx) + 3;
  camera.height = static_cast<int>((bottom - top) * camera.fy) + 3;
  return camera;
}

/// Fills empty pixels whose neighbours nearly all are measured and lie on one surface.
void fillHoles(RangeImage& image, float same_surface_m)
{
  const RangeImage before = image;
  for (int v = 1; v + 1 < image.camera.height; ++v)
    for (int u = 1; u + 1 < image.camera.width; ++u)
    {
      if (before.depth[before.index(u, v)] > 0) continue;
      float low = std::numeric_limits<float>::max(), high = 0, sum = 0;
      int count = 0, inside = 0;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du)
        {
          const std::size_t neighbor = before.index(u + du, v + dv);
          const float z = before.depth[neighbor];
          if (z == 0) continue;
          low = std::min(low, z), high = std::max(high, z), sum += z;
          inside += before.in_roi[neighbor];
          ++count;
        }
      if (count < 4 || high - low > 2 * same_surface_m) continue;
      image.depth[image.index(u, v)] = sum / static_cast<float>(count);
      image.in_roi[image.index(u, v)] = 2 * inside > count;
    }
}

/// Puts the nearest point of each pixel into the image.
void drawPoints(const PointCloud& cloud, const std::vector<std::uint8_t>& inside, RangeImage& image)
{
  const std::size_t pixels = static_cast<std::size_t>(image.camera.width) * image.camera.height;
  image.depth.assign(pixels, 0);
  image.in_roi.assign(pixels, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Eigen::Vector3f& p = cloud.points[i];
    int u, v;
    if (!measured(p) || !image.camera.pixelOf(p, u, v)) continue;
    const std::size_t index = image.index(u, v);
    if (image.depth[index] > 0 && image.depth[index] <= p.z()) continue;
    image.depth[index] = p.z();
    image.in_roi[index] = inside[i];
  }
}

/// Normals of the image's points from their neighbours in space.
void estimateNormals(RangeImage& image, float reach_m, int threads)
{
  std::vector<Eigen::Vector3f> points;
  std::vector<std::size_t> where;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      if (image.depth[image.index(u, v)] == 0) continue;
      points.push_back(image.point(u, v));
      where.push_back(image.index(u, v));
    }
  const std::vector<Eigen::Vector3f> normals =
      estimatePointNormals(points, kPointNeighbors, reach_m, threads);
  image.normals.assign(image.depth.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < where.size(); ++i)
    image.normals[where[i]] = normals[i];
}
}  // namespace

RangeImage imageOfPoints(const PointCloud& cloud, const std::vector<std::uint8_t>& inside,
                         float near_z, const RangeImageOptions& options)
{
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (inside[i]) points.push_back(cloud.points[i]);
  const auto diameter = static_cast<float>(options.diameter_m);
  const float wanted_rad = diameter / near_z / static_cast<float>(options.pixels_per_diameter);
  const float margin_rad = kMarginRel * static_cast<float>(options.largest_diameter_m) / near_z;
  RangeImage image;
  image.camera = cameraAround(points, std::max(wanted_rad, kPixelPerSpacing * pointSpacing(points)),
                              margin_rad);
  drawPoints(cloud, inside, image);
  fillHoles(image, kSameSurfaceRel * diameter);
  image.noise_m = depthNoise(image);
  image.normal_radius_px = options.normal_radius_px;
  const float pixel_m = near_z / image.camera.fx;
  if (options.use_cloud_normals && !cloud.normals.empty())
    takeCloudNormals(cloud, image);
  else
    estimateNormals(image, std::max(4 * pixel_m, kNormalGateRel * diameter), options.threads);
  return image;
}
}  // namespace ppf_bin_picking

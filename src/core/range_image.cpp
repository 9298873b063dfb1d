#include "ppf_bin_picking/core/range_image.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/normals.hpp"
#include "ppf_bin_picking/core/parallel.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kCameraSamples = 20000;  // points that the camera is fitted to
constexpr float kMaxCameraError_px = 0.5F;
constexpr std::size_t kSpacingSamples = 2000;  // points whose neighbours give the spacing
constexpr float kPixelPerSpacing = 1.0F;       // so that few pixels stay empty
constexpr int kMaxImageSide_px = 4000;
constexpr float kMarginRel = 0.6F;  // image around the region, relative to the largest part
constexpr int kPointNeighbors = 12;
constexpr float kNormalGateRel = 0.05F;   // of the smallest diameter
constexpr float kSameSurfaceRel = 0.02F;  // pixels this near in depth are averaged

bool measured(const Eigen::Vector3f& p)
{
  return p.allFinite() && p.z() > 0;
}

/// Least squares of pixel = focal * slope + center.
struct LineFit
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(double slope, double pixel)
  {
    n += 1, x += slope, y += pixel, xx += slope * slope, xy += slope * pixel;
  }
  bool solve(float& focal, float& center) const
  {
    const double determinant = n * xx - x * x;
    if (!(determinant > 1e-12 * n * n)) return false;
    focal = static_cast<float>((n * xy - x * y) / determinant);
    center = static_cast<float>((y - (n * xy - x * y) / determinant * x) / n);
    return focal > 0;
  }
};

/// The columns and rows of an image that matter.
struct Window
{
  int left = std::numeric_limits<int>::max();
  int top = std::numeric_limits<int>::max();
  int right = -1;
  int bottom = -1;
  float nearest_z = std::numeric_limits<float>::max();

  void add(int u, int v, float z)
  {
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
    nearest_z = std::min(nearest_z, z);
  }
  bool empty() const { return right < left; }
  void grow(int margin, int width, int height)
  {
    left = std::max(0, left - margin), right = std::min(width - 1, right + margin);
    top = std::max(0, top - margin), bottom = std::min(height - 1, bottom + margin);
  }
};

/// Marks the points in the region.
std::vector<std::uint8_t> pointsInRegion(const PointCloud& cloud,
                                         const std::optional<RegionOfInterest>& roi, int threads)
{
  std::vector<std::uint8_t> inside(cloud.size(), 0);
  const Eigen::Isometry3d T_box_cloud = roi ? roi->T_cloud_box.inverse(Eigen::Isometry)
                                            : Eigen::Isometry3d(Eigen::Isometry3d::Identity());
  const Eigen::Matrix3f rotation = T_box_cloud.linear().cast<float>();
  const Eigen::Vector3f shift = T_box_cloud.translation().cast<float>();
  const Eigen::Array3f low = (roi ? roi->min : Eigen::Vector3d(0, 0, 0)).cast<float>().array();
  const Eigen::Array3f high = (roi ? roi->max : Eigen::Vector3d(0, 0, 0)).cast<float>().array();
  constexpr std::size_t kBlock = 8192;
  parallelFor(threads, (cloud.size() + kBlock - 1) / kBlock,
              [&](std::size_t block)
              {
                const std::size_t end = std::min(cloud.size(), (block + 1) * kBlock);
                for (std::size_t i = block * kBlock; i < end; ++i)
                {
                  if (!measured(cloud.points[i])) continue;
                  const Eigen::Array3f p = (rotation * cloud.points[i] + shift).array();
                  inside[i] = !roi || ((p >= low).all() && (p <= high).all());
                }
              });
  return inside;
}

/// Averages blocks of factor x factor pixels: of each block the surface of its median depth.
RangeImage averagedDown(const PointCloud& cloud, const std::vector<std::uint8_t>& inside,
                        const PinholeCamera& camera, const Window& window, int factor,
                        float same_surface_m)
{
  RangeImage image;
  image.camera.width = (window.right - window.left + 1) / factor;
  image.camera.height = (window.bottom - window.top + 1) / factor;
  const auto f = static_cast<float>(factor);
  const float half = (f - 1) / 2;
  image.camera.fx = camera.fx / f;
  image.camera.fy = camera.fy / f;
  image.camera.cx = (camera.cx - static_cast<float>(window.left) - half) / f;
  image.camera.cy = (camera.cy - static_cast<float>(window.top) - half) / f;
  const std::size_t pixels = static_cast<std::size_t>(image.camera.width) * image.camera.height;
  image.depth.assign(pixels, 0);
  image.in_roi.assign(pixels, 0);
  std::vector<std::pair<float, std::uint8_t>> block;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      block.clear();
      for (int dv = 0; dv < factor; ++dv)
        for (int du = 0; du < factor; ++du)
        {
          const std::size_t i =
              static_cast<std::size_t>(window.top + v * factor + dv) * cloud.width +
              static_cast<std::size_t>(window.left + u * factor + du);
          if (measured(cloud.points[i])) block.emplace_back(cloud.points[i].z(), inside[i]);
        }
      if (block.empty()) continue;
      const auto middle = block.begin() + static_cast<std::ptrdiff_t>((block.size() - 1) / 2);
      std::nth_element(block.begin(), middle, block.end());
      const auto [median, median_inside] = *middle;
      float sum = 0, count = 0;
      for (const auto& [z, z_inside] : block)
        if (std::abs(z - median) < same_surface_m) sum += z, count += 1;
      image.depth[image.index(u, v)] = sum / count;
      image.in_roi[image.index(u, v)] = median_inside;
    }
  return image;
}

/// Normals of the cloud, at the pixels that show its points.
void takeCloudNormals(const PointCloud& cloud, RangeImage& image)
{
  image.normals.assign(image.depth.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (!measured(cloud.points[i]) || !cloud.normals[i].allFinite()) continue;
    int u, v;
    if (!image.camera.pixelOf(cloud.points[i], u, v) || cloud.normals[i].norm() < 0.5F) continue;
    const Eigen::Vector3f normal = cloud.normals[i].normalized();
    image.normals[image.index(u, v)] =
        normal.dot(cloud.points[i]) > 0 ? Eigen::Vector3f(-normal) : normal;
  }
}

RangeImageResult fromOrganised(const PointCloud& cloud, const PinholeCamera& camera,
                               const std::vector<std::uint8_t>& inside,
                               const RangeImageOptions& options)
{
  RangeImageResult result;
  Window window;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (inside[i])
    {
      window.add(static_cast<int>(i % cloud.width), static_cast<int>(i / cloud.width),
                 cloud.points[i].z());
      ++result.roi_points;
    }
  if (window.empty()) return result;
  const double per_meter = camera.fx / window.nearest_z;
  window.grow(static_cast<int>(std::ceil(kMarginRel * options.largest_diameter_m * per_meter)),
              camera.width, camera.height);
  const int factor = std::max(
      1, static_cast<int>(options.diameter_m * per_meter / options.pixels_per_diameter + 0.25));
  result.image = averagedDown(cloud, inside, camera, window, factor,
                              kSameSurfaceRel * static_cast<float>(options.diameter_m));
  if (options.use_cloud_normals && !cloud.normals.empty())
    takeCloudNormals(cloud, result.image);
  else
    estimateImageNormals(result.image, options.normal_radius_px,
                         kNormalGateRel * static_cast<float>(options.diameter_m), options.threads);
  return result;
}

/// Angle between neighbouring points as seen from the camera: the median over some of them [rad].
float pointSpacing(const std::vector<Eigen::Vector3f>& points)
{
  const NeighborSearch search(points);
  std::vector<float> spacings;
  std::vector<std::pair<std::uint32_t, float>> near;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSpacingSamples);
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    search.nearest(points[i], 2, near);
    if (near.size() == 2) spacings.push_back(std::sqrt(near[1].second) / points[i].z());
  }
  if (spacings.empty()) return 0;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

/// A camera at the origin that sees all points, and a margin around them, in pixels of a given
/// angle.
PinholeCamera cameraAround(const std::vector<Eigen::Vector3f>& points, float pixel_rad,
                           float margin_rad)
{
  Eigen::Array2f low = Eigen::Array2f::Constant(std::numeric_limits<float>::max());
  Eigen::Array2f high = -low;
  for (const Eigen::Vector3f& p : points)
  {
    const Eigen::Array2f slope = (p.head<2>() / p.z()).array();
    low = low.min(slope);
    high = high.max(slope);
  }
  low -= margin_rad;
  high += margin_rad;
  pixel_rad = std::max(pixel_rad, (high - low).maxCoeff() / static_cast<float>(kMaxImageSide_px));
  PinholeCamera camera;
  camera.fx = camera.fy = 1 / pixel_rad;
  camera.cx = 1 - low.x() * camera.fx;
  camera.cy = 1 - low.y() * camera.fy;
  camera.width = static_cast<int>((high.x() - low.x()) * camera.fx) + 3;
  camera.height = static_cast<int>((high.y() - low.y()) * camera.fy) + 3;
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

RangeImageResult fromPoints(const PointCloud& cloud, const std::vector<std::uint8_t>& inside,
                            const RangeImageOptions& options)
{
  RangeImageResult result;
  std::vector<Eigen::Vector3f> points;
  float nearest_z = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (!inside[i]) continue;
    points.push_back(cloud.points[i]);
    ++result.roi_points;
    nearest_z = std::min(nearest_z, cloud.points[i].z());
  }
  if (result.roi_points == 0) return result;
  const auto diameter = static_cast<float>(options.diameter_m);
  const float wanted_rad = diameter / nearest_z / static_cast<float>(options.pixels_per_diameter);
  RangeImage& image = result.image;
  const float margin_rad = kMarginRel * static_cast<float>(options.largest_diameter_m) / nearest_z;
  image.camera = cameraAround(points, std::max(wanted_rad, kPixelPerSpacing * pointSpacing(points)),
                              margin_rad);
  const std::size_t pixels = static_cast<std::size_t>(image.camera.width) * image.camera.height;
  image.depth.assign(pixels, 0);
  image.in_roi.assign(pixels, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)  // the nearest point of each pixel
  {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!measured(p)) continue;
    int u, v;
    if (!image.camera.pixelOf(p, u, v)) continue;
    const std::size_t index = image.index(u, v);
    if (image.depth[index] > 0 && image.depth[index] <= p.z()) continue;
    image.depth[index] = p.z();
    image.in_roi[index] = inside[i];
  }
  fillHoles(image, kSameSurfaceRel * diameter);
  if (options.use_cloud_normals && !cloud.normals.empty())
  {
    takeCloudNormals(cloud, image);
    return result;
  }
  std::vector<std::size_t> where;
  points.clear();
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
      if (image.depth[image.index(u, v)] > 0)
        points.push_back(image.point(u, v)), where.push_back(image.index(u, v));
  const float pixel_m = nearest_z / image.camera.fx;
  const std::vector<Eigen::Vector3f> normals = estimatePointNormals(
      points, kPointNeighbors, std::max(4 * pixel_m, kNormalGateRel * diameter), options.threads);
  image.normals.assign(pixels, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < where.size(); ++i)
    image.normals[where[i]] = normals[i];
  return result;
}
}  // namespace

std::optional<PinholeCamera> estimateCamera(const PointCloud& cloud)
{
  if (!cloud.organised()) return std::nullopt;
  PinholeCamera camera;
  camera.width = static_cast<int>(cloud.width);
  camera.height = static_cast<int>(cloud.height);
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / kCameraSamples) | 1;
  LineFit columns, rows;
  for (std::size_t i = 0; i < cloud.size(); i += stride)
  {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!measured(p)) continue;
    columns.add(p.x() / p.z(), static_cast<double>(i % cloud.width));
    rows.add(p.y() / p.z(), static_cast<double>(i / cloud.width));
  }
  if (!columns.solve(camera.fx, camera.cx) || !rows.solve(camera.fy, camera.cy))
    return std::nullopt;
  for (std::size_t i = 0; i < cloud.size(); i += stride)
  {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!measured(p)) continue;
    const Eigen::Vector2f pixel(static_cast<float>(i % cloud.width),
                                static_cast<float>(i / cloud.width));
    if ((camera.project(p) - pixel).cwiseAbs().maxCoeff() > kMaxCameraError_px) return std::nullopt;
  }
  return camera;
}

RangeImageResult makeRangeImage(const PointCloud& cloud, const std::optional<RegionOfInterest>& roi,
                                const RangeImageOptions& options)
{
  const std::vector<std::uint8_t> inside = pointsInRegion(cloud, roi, options.threads);
  const std::optional<PinholeCamera> camera = estimateCamera(cloud);
  return camera ? fromOrganised(cloud, *camera, inside, options)
                : fromPoints(cloud, inside, options);
}
}  // namespace ppf_bin_picking

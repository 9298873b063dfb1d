#include "ppf_bin_picking/core/range_image.hpp"

#include "ppf_bin_picking/core/parallel.hpp"

#include "range_image_makers.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kCameraSamples = 20000;  // points that the camera is fitted to
constexpr float kMaxCameraError_px = 0.5F;
constexpr std::size_t kDepthSamples = 20000;  // points whose percentile is taken
constexpr double kStrayShare = 0.05;          // of the points, nearer than the rest

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

/// Depth that a few stray points aside the points inside the region begin at [m].
/// @param inside  At least one point is.
float nearDepth(const PointCloud& cloud, const std::vector<std::uint8_t>& inside, std::size_t count)
{
  // Of points in any order all count, so that the order does not.
  const std::size_t stride =
      cloud.organised() ? std::max<std::size_t>(1, count / kDepthSamples) | 1 : 1;
  std::vector<float> depths;
  std::size_t left = 0;  // to the next that is taken
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (!inside[i]) continue;
    if (left == 0)
    {
      depths.push_back(cloud.points[i].z());
      left = stride;
    }
    --left;
  }
  return percentile(depths, kStrayShare);
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

float percentile(std::vector<float>& values, double share)
{
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

RangeImageResult makeRangeImage(const PointCloud& cloud, const std::optional<RegionOfInterest>& roi,
                                const RangeImageOptions& options)
{
  const std::vector<std::uint8_t> inside = pointsInRegion(cloud, roi, options.threads);
  RangeImageResult result;
  result.roi_points = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));
  if (result.roi_points == 0) return result;
  const float near_z = nearDepth(cloud, inside, result.roi_points);
  const std::optional<PinholeCamera> camera = estimateCamera(cloud);
  result.image = camera ? imageOfOrganised(cloud, *camera, inside, near_z, options)
                        : imageOfPoints(cloud, inside, near_z, options);
  result.image.whole_cloud = !roi;
  result.near_z_m = near_z;
  result.pixels_per_diameter = options.diameter_m * result.image.camera.fx / near_z;
  return result;
}
}  // namespace ppf_bin_picking

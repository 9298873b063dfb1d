#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/normals.hpp"
#include "ppf_bin_picking/core/parallel.hpp"

#include "range_image_makers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMostTurn_rad = 0.15;  // of a normal, by noise, as a standard deviation
constexpr int kWidestRadius_px = 5;
constexpr double kGateNoises = 7;  // that a normal's neighbourhood reaches at least

/// The columns and rows of an image that matter.
struct Window
{
  int left = std::numeric_limits<int>::max();
  int top = std::numeric_limits<int>::max();
  int right = -1;
  int bottom = -1;

  void add(int u, int v)
  {
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
  void grow(int margin, int width, int height)
  {
    left = std::max(0, left - margin), right = std::min(width - 1, right + margin);
    top = std::max(0, top - margin), bottom = std::min(height - 1, bottom + margin);
  }
};

/// A depth and whether its point lies in the region.
struct BlockPixel
{
  float depth_m;
  std::uint8_t inside;

  bool operator<(const BlockPixel& other) const { return depth_m < other.depth_m; }
};

/// The mean depth of the surface that the median belongs to. Reorders the block, which is not
/// empty.
BlockPixel averageOf(std::vector<BlockPixel>& block, float same_surface_m)
{
  float sum = 0, least = block.front().depth_m, most = least;
  std::size_t inside = 0;
  for (const BlockPixel& pixel : block)
  {
    sum += pixel.depth_m, inside += pixel.inside;
    least = std::min(least, pixel.depth_m), most = std::max(most, pixel.depth_m);
  }
  const bool is_alike = inside == 0 || inside == block.size();
  if (is_alike && most - least < same_surface_m)  // the usual case, without sorting
    return {sum / static_cast<float>(block.size()), block.front().inside};
  const auto middle = block.begin() + static_cast<std::ptrdiff_t>((block.size() - 1) / 2);
  std::nth_element(block.begin(), middle, block.end());
  const BlockPixel median = *middle;
  float count = 0;
  sum = 0;
  for (const BlockPixel& pixel : block)
    if (std::abs(pixel.depth_m - median.depth_m) < same_surface_m) sum += pixel.depth_m, count += 1;
  return {sum / count, median.inside};
}

/// Averages blocks of factor x factor pixels: of each block the surface of its median depth.
RangeImage averagedDown(const PointCloud& cloud, const std::vector<std::uint8_t>& inside,
                        const PinholeCamera& camera, const Window& window, int factor,
                        float same_surface_m, int threads)
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
  const auto average_row = [&](std::size_t row)
  {
    const int v = static_cast<int>(row);
    std::vector<BlockPixel> block;
    for (int u = 0; u < image.camera.width; ++u)
    {
      block.clear();
      for (int dv = 0; dv < factor; ++dv)
        for (int du = 0; du < factor; ++du)
        {
          const std::size_t i =
              static_cast<std::size_t>(window.top + v * factor + dv) * cloud.width +
              static_cast<std::size_t>(window.left + u * factor + du);
          if (measured(cloud.points[i])) block.push_back({cloud.points[i].z(), inside[i]});
        }
      if (block.empty()) continue;
      const BlockPixel pixel = averageOf(block, same_surface_m);
      image.depth[image.index(u, v)] = pixel.depth_m;
      image.in_roi[image.index(u, v)] = pixel.inside;
    }
  };
  parallelFor(threads, static_cast<std::size_t>(image.camera.height), average_row);
  return image;
}

/// The half window from which on noise turns the planes by no more than kMostTurn_rad.
/// @param slope_noise  Of the depth from pixel to pixel, in pixels.
int normalRadius(double slope_noise, int least_px)
{
  for (int radius_px = least_px; radius_px < kWidestRadius_px; ++radius_px)
  {
    // The sum of the squared steps of a window's pixels along one direction.
    const double width = 2 * radius_px + 1;
    const double squares = width * width * radius_px * (radius_px + 1) / 3;
    if (slope_noise <= kMostTurn_rad * std::sqrt(squares)) return radius_px;
  }
  return std::max(least_px, kWidestRadius_px);
}

/// Normals from planes through windows that suit the noise.
void estimateNormals(RangeImage& image, float near_z, const RangeImageOptions& options)
{
  const double pixel_m = near_z / image.camera.fx;
  image.normal_radius_px = normalRadius(image.noise_m / pixel_m, options.normal_radius_px);
  const auto gate_m = static_cast<float>(
      std::max<double>(kNormalGateRel * options.diameter_m, kGateNoises * image.noise_m));
  estimateImageNormals(image, image.normal_radius_px, gate_m, options.threads);
}
}  // namespace

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

RangeImage imageOfOrganised(const PointCloud& cloud, const PinholeCamera& camera,
                            const std::vector<std::uint8_t>& inside, float near_z,
                            const RangeImageOptions& options)
{
  Window window;
  for (int v = 0; v < camera.height; ++v)
  {
    const auto row = inside.begin() + static_cast<std::ptrdiff_t>(v) * camera.width;
    const auto first = std::find(row, row + camera.width, 1);
    if (first == row + camera.width) continue;
    const auto last = std::find(std::make_reverse_iterator(row + camera.width),
                                std::make_reverse_iterator(first), 1);
    window.add(static_cast<int>(first - row), v);
    window.add(static_cast<int>(last.base() - row) - 1, v);
  }
  const double per_meter = camera.fx / near_z;
  const double margin_px = kMarginRel * options.largest_diameter_m * per_meter;
  const int largest_side_px = std::max(camera.width, camera.height);
  window.grow(static_cast<int>(std::min<double>(std::ceil(margin_px), largest_side_px)),
              camera.width, camera.height);
  const double wanted_factor = options.diameter_m * per_meter / options.pixels_per_diameter + 0.25;
  const int factor = static_cast<int>(std::clamp<double>(wanted_factor, 1, largest_side_px));
  RangeImage image =
      averagedDown(cloud, inside, camera, window, factor,
                   kSameSurfaceRel * static_cast<float>(options.diameter_m), options.threads);
  image.noise_m = depthNoise(image);
  image.normal_radius_px = options.normal_radius_px;
  if (options.use_cloud_normals && !cloud.normals.empty())
    takeCloudNormals(cloud, image);
  else
    estimateNormals(image, near_z, options);
  return image;
}
}  // namespace ppf_bin_picking

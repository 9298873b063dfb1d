/// @file The cloud as a depth image of the part's resolution, with normals: what all later stages
/// look at.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// A depth image around the region of interest. Pixels row after row.
struct RangeImage
{
  PinholeCamera camera;
  std::vector<float> depth;              ///< Along z [m]; 0 without measurement.
  std::vector<Eigen::Vector3f> normals;  ///< Unit length, towards the camera; zero where unknown.
  std::vector<std::uint8_t> in_roi;  ///< 1 where the measured point lies in the region of interest.
  bool whole_cloud = false;          ///< Without a region of interest: all points lie in it.
  double noise_m = 0;                ///< Of the depth, see depthNoise().
  int normal_radius_px = 2;          ///< Half window of the plane fits that the normals are from.

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * camera.width + u; }
  Eigen::Vector3f point(int u, int v) const
  {
    return camera.ray(static_cast<float>(u), static_cast<float>(v)) * depth[index(u, v)];
  }
};

/// How the image is made.
struct RangeImageOptions
{
  double diameter_m = 0;  ///< Of the smallest part; sets the resolution. > 0.
  double largest_diameter_m =
      0;  ///< Of the largest part; the image reaches this far around the region.
  double pixels_per_diameter = 100;  ///< Resolution aimed at.
  int normal_radius_px = 2;          ///< Half window of the plane fits, where there is no noise.
  bool use_cloud_normals = false;    ///< Take the cloud's normals where it has them.
  int threads = 0;
};

/// The image and what was found on the way.
struct RangeImageResult
{
  RangeImage image;
  std::size_t roi_points = 0;      ///< Measured points of the cloud inside the region.
  double near_z_m = 0;             ///< Depth that 5 % of these points are nearer than.
  double pixels_per_diameter = 0;  ///< Of the smallest part, where the points are nearest.
};

/// The pinhole camera that made an organised cloud, by least squares over its points.
/// @return Nothing if the cloud is not organised, has too few points, or a point lies more than
/// half a pixel off.
std::optional<PinholeCamera> estimateCamera(const PointCloud& cloud);

/// Makes the image; it stays empty without a point in the region. Stray points decide neither its
/// resolution nor its size. An organised cloud keeps its pixels, averaged down by a whole number;
/// normals come from the neighbourhood in the image, which is taken wider where the depth is noisy.
/// Any other cloud is projected into a camera of its own whose pixel is as large as the points'
/// spacing; normals come from the nearest points in space.
RangeImageResult makeRangeImage(const PointCloud& cloud, const std::optional<RegionOfInterest>& roi,
                                const RangeImageOptions& options);
}  // namespace ppf_bin_picking

/// @file The two ways to a range image; private to the core.
#pragma once

#include "ppf_bin_picking/core/range_image.hpp"

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
constexpr float kMarginRel = 0.6F;  ///< Image around the region, relative to the largest part.
constexpr float kNormalGateRel =
    0.05F;  ///< Reach of a normal's neighbourhood, of the smallest diameter.
constexpr float kSameSurfaceRel =
    0.02F;  ///< Depths this near belong to one surface, of the smallest diameter.

/// The value that a share of the values are below. @param values  Not empty; gets another order.
float percentile(std::vector<float>& values, double share);

/// Puts the cloud's normals at the pixels that show its points, turned towards the camera.
void takeCloudNormals(const PointCloud& cloud, RangeImage& image);

/// The image of an organised cloud: its own pixels around the region, averaged down by a whole
/// number.
/// @param inside  1 for each point in the region of interest; at least one.
/// @param near_z  Depth that the resolution is chosen for [m].
RangeImage imageOfOrganised(const PointCloud& cloud, const PinholeCamera& camera,
                            const std::vector<std::uint8_t>& inside, float near_z,
                            const RangeImageOptions& options);

/// The image of points in any order, seen from the origin in pixels as large as their spacing.
/// @param inside  1 for each point in the region of interest; at least one.
/// @param near_z  Depth that the resolution is chosen for [m].
RangeImage imageOfPoints(const PointCloud& cloud, const std::vector<std::uint8_t>& inside,
                         float near_z, const RangeImageOptions& options);
}  // namespace ppf_bin_picking

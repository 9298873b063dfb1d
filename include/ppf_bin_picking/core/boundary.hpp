/// @file Points where a surface ends before something farther back. Each has a full frame, so that
/// two of them that match give a pose without an angle left open.
#pragma once

#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

#include <vector>

namespace ppf_bin_picking
{
/// A point of a surface's boundary.
struct BoundaryPoint
{
  Eigen::Vector3f point;    ///< [m]
  Eigen::Vector3f normal;   ///< Of the surface that ends there, unit length.
  Eigen::Vector3f outward;  ///< Along the surface, across the boundary, unit length.

  /// Columns: normal, outward, their cross product.
  Eigen::Matrix3f frame() const
  {
    Eigen::Matrix3f axes;
    axes << normal, outward, normal.cross(outward);
    return axes;
  }
};

/// The boundary points of an image, in the camera frame: pixels of the region of interest beyond
/// which the image falls back by more than a step, perhaps with a gap of missing pixels between.
/// Surfaces flat to the line of sight are left out, since their edge moves with the camera.
/// @param jump_m   Least fall.
/// @param threads  0: one per core.
std::vector<BoundaryPoint> boundaryOf(const RangeImage& image, float jump_m, int threads);

/// Thins out boundary points to one a cell of a cubic grid and direction: points of a cell whose
/// normals and outward directions lie within 30 degrees of the first become their mean. Ordered by
/// first point.
std::vector<BoundaryPoint> thinOutBoundary(const std::vector<BoundaryPoint>& points, float cell_m);
}  // namespace ppf_bin_picking

/// @file Planes that cut a surface.
#pragma once

#include "triangle_points.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
struct Plane
{
  Eigen::Vector3d normal;
  double offset = 0;  ///< normal . point of its points
};

/// What of a surface lies on the side that the plane's normal points to.
std::vector<Triangle> clipped(const std::vector<Triangle>& surface, const Plane& plane);

/// Planes of the larger flat faces of a surface, largest first.
/// @param offset_step_m  Parallel faces are told apart by about that much.
std::vector<Plane> flatFaces(const std::vector<Triangle>& surface, double offset_step_m,
                             std::size_t most);
}  // namespace ppf_bin_picking

/// @file Points on triangles.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace ppf_bin_picking
{
using Triangle = std::array<Eigen::Vector3d, 3>;  ///< Corners [m].

Triangle cornersOf(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle);

/// The point of a triangle that is nearest to another point: its projection where that lies inside,
/// else the nearest point of a side.
Eigen::Vector3d nearestOnTriangle(const Triangle& triangle, const Eigen::Vector3d& point);

/// A regular grid over the inside of a triangle, at most spacing_m apart; one point at least.
std::vector<Eigen::Vector3d> spreadPoints(const Triangle& triangle, double spacing_m);
}  // namespace ppf_bin_picking

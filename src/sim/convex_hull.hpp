/// @file The convex hull of points.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace ppf_bin_picking
{
using Points = std::vector<Eigen::Vector3d>;

/// A convex body [m].
struct ConvexHull
{
  TriangleMesh mesh;  ///< Closed, wound outwards; empty where the points have no volume.
  double volume = 0;    ///< [m^3]
  double shrunk_m = 0;  ///< By how much its faces were moved inwards.
};

/// Hull of some points, every one of its vertices (about) one of them.
/// @param shrink_m  Its faces are moved inwards by that much, though by no more than two fifths of
///                  the inner radius. >= 0.
ConvexHull convexHull(const Points& points, double shrink_m = 0);

/// Hull of some of the points, which all others exceed by at most tolerance_m.
/// @param most  Vertices, even if the tolerance is then missed. >= 8.
ConvexHull simplifiedHull(const Points& points, double tolerance_m, std::size_t most);

/// Volume [m^3] enclosed by a closed mesh; below 0 if wound inwards.
double enclosedVolume(const TriangleMesh& mesh);
}  // namespace ppf_bin_picking

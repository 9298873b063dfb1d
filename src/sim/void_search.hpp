/// @file Where a convex hull bridges a gap of a part.
#pragma once

#include "convex_hull.hpp"

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <Eigen/Core>

#include <vector>

namespace ppf_bin_picking
{
/// A point of a hull's surface that lies outside the part.
struct VoidPoint
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();   ///< On the part's surface [m].
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< Of the surface there; unit length.
  double depth_m = 0;                                  ///< Distance to `nearest`.
};

/// A part's surface, to be asked how far a hull is from it.
class VoidSearch
{
public:
  /// @param part  Closed, wound outwards, with an extent above 0; kept by reference.
  VoidSearch(const TriangleMesh& part, double spacing_m);

  /// Points of the hull's surface, about spacing_m apart, which lie outside the part and further
  /// than least_m from it: the deepest first.
  std::vector<VoidPoint> voids(const TriangleMesh& hull, double least_m) const;

  bool isInside(const Eigen::Vector3d& point) const;

private:
  /// How many closed shells a point lies in: a part may be made of several that overlap.
  int shellsAround(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const;
  VoidPoint nearestSurface(const Eigen::Vector3d& point) const;

  const TriangleMesh& part_;
  double spacing_m_;
  RayCaster caster_;
  std::vector<Eigen::Vector3d> centers_;  // of the triangles' bounding spheres
  std::vector<double> radii_;
};
}  // namespace ppf_bin_picking

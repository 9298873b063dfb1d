/// @file Collision shapes for Bullet.
#pragma once

#include "convex_hull.hpp"

#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include <Eigen/Geometry>

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

namespace ppf_bin_picking
{
btVector3 bulletPoint(const Eigen::Vector3d& point);
btQuaternion bulletRotation(const Eigen::Quaterniond& rotation);

/// Largest side [m] of the box along the axes that holds all hulls.
double largestExtent(const ConvexHulls& hulls);

/// The hull of some points [m]: no larger, its edges rounded by Bullet's margin.
/// @param T_shape_points  Where the points lie in the shape's frame [m].
/// @param scale           Bullet's units per metre.
std::unique_ptr<btConvexHullShape> hullShape(const Points& points,
                                             const Eigen::Isometry3d& T_shape_points, double scale);

/// A part's hulls as one shape.
class PartShape
{
public:
  PartShape(const ConvexHulls& hulls, const Eigen::Isometry3d& T_body_part, double scale);

  /// Lives as long as this.
  btCollisionShape* compound() { return &compound_; }

private:
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  btCompoundShape compound_;
};
}  // namespace ppf_bin_picking

/// @file Where a body balances and how it resists turning.
#pragma once

#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// Of a body of density 1.
struct MassProperties
{
  double volume = 0;  ///< [m^3]
  /// Origin in the centre of mass, axes along the principal axes of inertia [m].
  Eigen::Isometry3d T_part_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();  ///< About these axes [m^5].
};

/// Of bodies taken together; what they share counts twice.
/// @param bodies  Closed, wound outwards.
/// @throw std::invalid_argument if they have no volume.
MassProperties massProperties(const ConvexHulls& bodies);
}  // namespace ppf_bin_picking

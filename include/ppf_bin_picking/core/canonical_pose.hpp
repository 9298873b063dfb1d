/// @file One of the poses that a part's symmetries make equal.
#pragma once

#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// The pose of the orbit T S, S any symmetry of the part, that is turned least from the reference
/// orientation, 60 degrees about (1, 2, 3) of the cloud's frame. It is the same for all poses of an
/// orbit and changes steadily with the pose, but where two poses of the orbit are turned equally;
/// then the one whose turn from the reference has the largest x, then y, then z decides (as a
/// quaternion of positive w). The reference is oblique so that no part lying flat, standing or
/// upside down is such a case. A sphere has the reference orientation.
/// @param T_cloud_model  Any pose of the orbit [m].
/// @return T_cloud_model of the part at the same place: the mesh's origin moves where it does not
/// lie on the axes.
Eigen::Isometry3d canonicalPose(const Eigen::Isometry3d& T_cloud_model,
                                const SymmetryGroup& symmetries);
}  // namespace ppf_bin_picking

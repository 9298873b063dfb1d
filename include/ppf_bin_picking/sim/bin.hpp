/// @file The bin that parts lie in.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Core>

namespace ppf_bin_picking
{
/// An open box. Its frame: origin in the middle of the floor's upper side, z up, x along size.x().
struct Bin
{
  Eigen::Vector3d size_m = {0.3, 0.2, 0.08};  ///< Inside: length, width, height. > 0.
  double wall_m = 0.004;                      ///< Thickness of floor and walls. > 0.
};

/// Floor and four walls [m], bin frame; closed boxes, wound outwards.
TriangleMesh binMesh(const Bin& bin);
}  // namespace ppf_bin_picking

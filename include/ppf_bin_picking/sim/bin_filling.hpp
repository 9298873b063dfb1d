/// @file Parts lying in a bin, without physics.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// An open box. Its frame: origin in the middle of the floor's upper side, z up, x along size.x().
struct Bin
{
  Eigen::Vector3d size_m = {0.3, 0.2, 0.08};  ///< Inside: length, width, height. > 0.
  double wall_m = 0.004;                      ///< Thickness of floor and walls. > 0.
};

/// Floor and four walls [m], bin frame.
TriangleMesh binMesh(const Bin& bin);

/// Lays parts into a bin one after the other: each comes to rest on a face it is stable on, or
/// leans by up to 0.4 rad, and is lowered straight down at the place, of a few tried, where it gets
/// deepest. Parts touch but do not share space (by more than a fraction of a millimetre); the pile
/// may rise above the walls. It is a likely looking heap, not a physical one: a part may stand on
/// one point of contact.
/// @param part   A closed mesh, wound outwards.
/// @param count  How many parts. >= 0.
/// @return T_bin_part for each. The same seed gives the same poses.
/// @throw std::invalid_argument if the part does not fit into the bin.
std::vector<Eigen::Isometry3d> fillBin(const Bin& bin, const TriangleMesh& part, int count,
                                       std::uint32_t seed);
}  // namespace ppf_bin_picking

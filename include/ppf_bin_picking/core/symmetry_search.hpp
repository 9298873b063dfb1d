/// @file The symmetries that a mesh has.
#pragma once

#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

namespace ppf_bin_picking
{
/// A turn that leaves the surface within this distance of itself, relative to the diameter, is
/// found as a symmetry: less than half of the least depth that the detector sees
/// (depth_gate_rel), so that it does see whatever is no symmetry, and more than the facets of a
/// round leave (0.0076 for 18 around a disc).
constexpr double kFoundSymmetryRel = 0.008;

/// Finds the turns that map the outside of a mesh onto itself within kFoundSymmetryRel: all turns
/// of a ball, a revolution with or without a half turn across it, turns about one axis with or
/// without half turns across it, up to 120 a turn, and those of a cube or a tetrahedron. Axes
/// within 0.1 degrees of a coordinate axis, or of a line halfway between such, are taken for it. Of
/// an icosahedron's turns only those about one axis are found.
/// @param mesh  Metres.
/// @throw std::invalid_argument if it has no surface.
SymmetryGroup findSymmetries(const TriangleMesh& mesh);
}  // namespace ppf_bin_picking

/// @file Whether a mesh has the symmetries that are stated of it, and symmetries in words.
#pragma once

#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <string>

namespace ppf_bin_picking
{
/// A stated symmetry is believed up to this distance, relative to the diameter: what differs less
/// the detector cannot tell apart, so that whoever states it decides.
constexpr double kStatedSymmetryRel = 0.02;

/// Checks stated symmetries against the mesh.
/// @return One sentence that names the first turn which moves the surface farther than
/// kStatedSymmetryRel, by how much, and the remedy; empty if there is none.
/// @throw std::invalid_argument if the mesh has no surface.
std::string symmetryProblem(const TriangleMesh& mesh, const SymmetryGroup& stated);

/// Compares the symmetries that are stated of a part with those that its mesh has. Poses that
/// differ by a symmetry which is not stated are rivals of each other, so that none of them is
/// reliable.
/// @param stated  Without symmetryProblem().
/// @param found   findSymmetries() of the mesh.
/// @return The found generators that `stated` has not, as by describe(); empty if it has all.
std::string unstatedSymmetries(const SymmetryGroup& stated, const SymmetryGroup& found,
                               double metres_per_unit);

/// `none`, or generators in words: `1/6 turn about [0, 0, 1] through [0, 0, 0]`.
/// @param metres_per_unit  Of the points named.
std::string describe(const SymmetryGroup& symmetries, double metres_per_unit);
}  // namespace ppf_bin_picking

/// @file Lines that a mesh's axes of symmetry may lie near.
#pragma once

#include "ppf_bin_picking/core/self_distance.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// The three principal axes of the surface: an axis of symmetry that no other axis equals is one.
std::vector<SymmetryAxis> principalLines(const SelfDistance& self);

/// The axes of turns about the surface's centre that map a rare point of the surface to one like
/// it, distance from the centre and normal alike, and the rest of the surface nearly onto itself.
std::vector<SymmetryAxis> linesOfLikePoints(const SelfDistance& self);
}  // namespace ppf_bin_picking

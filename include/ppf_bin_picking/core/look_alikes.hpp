/// @file The turns that take a part's surface nearly onto itself: what a pose is confused with.
#pragma once

#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Geometry>

#include <vector>

namespace ppf_bin_picking
{
struct PpfModelData;

/// Turns of the part that leave at least half of its surface in place and are none of its
/// symmetries: end for end, upside down, or a round part a little on. Where the camera
/// sees little but that half, a pose and the turned one explain the cloud alike. Tried are turns
/// by multiples of 30 and 45 degrees about the principal axes of the part's samples through the
/// middle of their box; the refinement does the rest.
/// @return T_model_model in the mesh frame [m], those that leave most in place first, at most 3.
std::vector<Eigen::Isometry3f> lookAlikeTurns(const PpfModelData& model,
                                              const SymmetryGroup& symmetries);
}  // namespace ppf_bin_picking

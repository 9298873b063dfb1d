/// @file One point for all those that a part's symmetries lay onto each other.
#pragma once

#include "ppf_bin_picking/core/surface_sampling.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Marks points of one fundamental domain of the discrete symmetries: they lay each point onto one
/// that is marked. Without symmetries all are.
/// @param center  Mesh frame [m]; the points are relative to it, the symmetries are not.
/// @param tie_m   Points of which others of the orbit are preferred by less are marked, too [m].
std::vector<std::uint8_t> inFundamentalDomain(const SymmetryGroup& symmetries,
                                              const Eigen::Vector3f& center, float tie_m,
                                              const std::vector<Eigen::Vector3f>& points);

/// Moves samples to the front that stand for all: some symmetry lays any part of the surface onto
/// a part that they cover. Without symmetries these are all samples. The order is kept otherwise.
/// Under discrete symmetries they are those of one fundamental domain; under a revolution one
/// sample of the circles that lie within half a step of each other; of a sphere 32 all over it.
/// @param center   Mesh frame [m]; the samples are relative to it, the symmetries are not.
/// @param step_m   Distance of the samples.
/// @return How many stand for all.
std::size_t moveRepresentativesToFront(const SymmetryGroup& symmetries,
                                       const Eigen::Vector3f& center, float step_m,
                                       OrientedPoints& samples);
}  // namespace ppf_bin_picking

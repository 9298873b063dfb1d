/// @file The box around points along their principal axes.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"

#include <Eigen/Core>

#include <vector>

namespace ppf_bin_picking
{
/// Principal component analysis of points [m]: the axes are the covariance's eigenvectors, largest
/// variance first, right-handed, the largest component of the first two positive; the box is the
/// smallest along them that holds every point, and its frame stands in its middle.
/// @param points  Finite; none yields a box without size at the origin.
OrientedBox principalBox(const std::vector<Eigen::Vector3f>& points);

/// Sum of the side lengths [m].
double sideSum(const OrientedBox& box);
}  // namespace ppf_bin_picking

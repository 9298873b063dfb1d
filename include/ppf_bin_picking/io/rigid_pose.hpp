/// @file Poses as 16 numbers in files.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// @param row_major  The 4x4 matrix row by row, translation in metres.
/// @return Nothing unless these are 16 finite numbers of a rotation (to 1e-3) and a translation.
std::optional<Eigen::Isometry3d> rigidPose(const std::vector<double>& row_major);

/// The inverse of rigidPose().
std::array<double, 16> rowMajor(const Eigen::Isometry3d& pose);
}  // namespace ppf_bin_picking

/// @file Cameras spread evenly around a part.
#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace ppf_bin_picking
{
/// Direction `index` of `count` that are spread evenly over the sphere, unit length.
Eigen::Vector3f evenDirection(int index, int count);

/// Camera poses that look at a centre from all sides, on a spherical Fibonacci lattice.
/// @param center      Mesh frame [m].
/// @param distance_m  Of the cameras from the centre.
/// @return T_camera_model of each.
std::vector<Eigen::Isometry3f> viewpointsAround(const Eigen::Vector3f& center, float distance_m,
                                                int count);
}  // namespace ppf_bin_picking

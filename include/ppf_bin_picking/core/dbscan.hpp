/// @file Clusters of points of any shape (Ester et al. 1996).
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Label of a point in no cluster.
constexpr std::int32_t kNoise = -1;

/// DBSCAN. A neighbourhood holds all points within eps_m, the point itself included; a point is a
/// core point if its neighbourhood holds at least minpts. Clusters are numbered in the order of
/// their first core point; a border point of several clusters belongs to the first of them.
/// @param points  Finite [m].
/// @param eps_m   > 0.
/// @param minpts  >= 1.
/// @return A label for each point: its cluster's number from 0, or kNoise.
std::vector<std::int32_t> dbscan(const std::vector<Eigen::Vector3f>& points, float eps_m,
                                 std::size_t minpts);
}  // namespace ppf_bin_picking

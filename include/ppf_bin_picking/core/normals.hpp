/// @file Normals of depth images and of points in any order.
#pragma once

#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Core>

#include <vector>

namespace ppf_bin_picking
{
/// Fits a plane to the window around each measured pixel. The image of a plane is linear in 1/z, so
/// the fit is exact for planes. Neighbours that lie off in depth are left out. Fills image.normals.
/// @param radius_px    Half window.
/// @param depth_gate_m A neighbour farther off along z belongs to another surface.
/// @param threads      0: one per core.
void estimateImageNormals(RangeImage& image, int radius_px, float depth_gate_m, int threads);

/// Fits a plane to the nearest neighbours of each point (principal axes); normals point to the
/// origin.
/// @param points        Finite [m].
/// @param neighbors     Number of neighbours, the point included.
/// @param max_radius_m  Neighbours farther off are left out; with fewer than 4 the normal is zero.
std::vector<Eigen::Vector3f> estimatePointNormals(const std::vector<Eigen::Vector3f>& points,
                                                  int neighbors, float max_radius_m, int threads);
}  // namespace ppf_bin_picking

/// @file Meshes that are quick to send and to draw.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <cstddef>

namespace ppf_bin_picking_ros
{
/// A mesh of similar shape with few triangles: the vertices of one grid cell become one, and the
/// grid is as fine as the limit allows.
/// @param max_triangles  At least 1. A mesh that has no more comes back as it is.
ppf_bin_picking::TriangleMesh simplifiedMesh(const ppf_bin_picking::TriangleMesh& mesh,
                                             std::size_t max_triangles);
}  // namespace ppf_bin_picking_ros

/// @file A part's surface as triangles.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Triangles in the mesh's own frame. The winding may be wrong and the surface open.
struct TriangleMesh
{
  std::vector<Eigen::Vector3f> vertices;                ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into vertices.
};
}  // namespace ppf_bin_picking

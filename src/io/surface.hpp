/// @file From triangles as a file holds them to a mesh without doubles, gaps in its numbers or
/// triangles without area.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Triangles in the file's unit.
struct RawSurface
{
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< As stated by the file; as many as vertices.
  std::vector<std::array<std::size_t, 3>> triangles;
};

struct CleanSurface
{
  TriangleMesh mesh;                 ///< [m]
  std::size_t all = 0;               ///< Triangles before cleaning.
  std::size_t not_finite = 0;        ///< Dropped: a coordinate is NaN or infinite.
  std::size_t without_area = 0;      ///< Dropped: corners on one line or in one point.
  std::size_t repeated = 0;          ///< Dropped: the same triangle again.
  std::size_t contrary_normals = 0;  ///< Kept: the stated normal is not that of the corners.
  std::size_t open_edges = 0;        ///< Edges with an odd number of triangles; 0: closed.
  double extent_m = 0;               ///< Longest side of the bounding box [m].

  /// What a person should know, as parts of sentences that follow the file's name.
  std::vector<std::string> oddities(bool normals_matter) const;
};

/// Scales, merges equal vertices and drops what is no surface.
CleanSurface cleaned(const RawSurface& raw, double metres_per_unit);
}  // namespace ppf_bin_picking

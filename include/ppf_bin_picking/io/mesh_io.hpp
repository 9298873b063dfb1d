/// @file Reading a part's surface from STL, OBJ and PLY files.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/io/length_unit.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
struct LoadedMesh
{
  TriangleMesh mesh;                  ///< [m]; equal vertices merged, no triangle without area.
  std::vector<std::string> warnings;  ///< One sentence each, naming the file: what was odd in it.
};

/// Reads a mesh. What is badly written but whole is mended, with a warning.
/// @param unit  Of the file's coordinates.
/// @throw InputError naming the file, if it cannot be read, holds no finite surface, or shows signs
///        of a lost part of it: facets missing against its own count, cut off, without all corners,
///        and the surface that is left is not closed.
LoadedMesh loadMesh(const std::string& path, LengthUnit unit);

/// The distinct finite vertices of a mesh file, by x, then y, then z, without rounding to single
/// precision metres: what poses are judged by.
/// @param unit  Of the file's coordinates; the vertices are in metres.
/// @throw InputError naming the file, if it cannot be read or holds no vertex.
std::vector<Eigen::Vector3d> loadVertices(const std::string& path, LengthUnit unit);

/// CRC-32 of vertices [m] and triangles: another mesh, or the same in another unit, gives another.
std::uint32_t meshChecksum(const TriangleMesh& mesh);
}  // namespace ppf_bin_picking

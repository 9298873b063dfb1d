/// @file A part as a few convex pieces, which is what the physics can handle.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Convex closed meshes in the part's frame [m], wound outwards. They may touch and overlap.
using ConvexHulls = std::vector<TriangleMesh>;

/// Splits a part into convex pieces: one for a convex part, more where it has holes or inner
/// corners. The part is cut by planes, the worst piece first, until no piece's hull bridges a gap
/// that is deeper than a hundredth of the part's largest extent, or 32 pieces are there. Every
/// vertex lies on the part's surface or inside it; a curved surface is followed to a
/// five-hundredth of the extent. Takes up to some seconds.
/// @param part  A closed mesh, wound outwards.
/// @throw std::invalid_argument if the part has no volume or names a vertex it does not have.
ConvexHulls convexHulls(const TriangleMesh& part);

/// The same, remembered in a file of the folder, which is made if need be. The file's name and
/// content hold a checksum of the mesh: a file of another mesh, or one that is damaged, is computed
/// anew and replaced. A file is written beside its place and renamed, so that several processes may
/// share a folder.
/// @throw std::invalid_argument as convexHulls(). @throw std::runtime_error naming the folder, if
///        it cannot be written.
ConvexHulls cachedConvexHulls(const TriangleMesh& part, const std::string& cache_folder);
}  // namespace ppf_bin_picking

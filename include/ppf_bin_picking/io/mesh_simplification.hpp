/// @file Meshes of fewer triangles and the same shape.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <cstddef>

namespace ppf_bin_picking
{
/// A mesh with at most so many triangles, or more where its shape does not allow it: edges are
/// collapsed, from those on that change the surface least (Garland and Heckbert, Surface
/// Simplification Using Quadric Error Metrics, SIGGRAPH 1997; VTK's). A mesh that has no more comes
/// back as it is.
TriangleMesh decimated(const TriangleMesh& mesh, std::size_t max_triangles);

/// Of a mesh of more than 8000 triangles one that is quick to train from and to render: 2000
/// triangles, or half as many more, again and again, until samples of either mesh, a hundredth of
/// the diameter apart, are within a thousandth of the diameter of the other, and a closed mesh
/// stays closed. One that neither two thirds of its triangles nor 60000 describe so comes back as
/// it is: a scan whose noise is near a thousandth of the diameter, for instance.
/// @param mesh  Equal vertices merged, as loadMesh() returns it [m].
TriangleMesh simplifiedMesh(const TriangleMesh& mesh);
}  // namespace ppf_bin_picking

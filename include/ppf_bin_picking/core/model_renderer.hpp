/// @file What a camera would see of a part at a pose.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// A mesh made ready for drawing. Copies what it needs.
struct RenderableMesh
{
  explicit RenderableMesh(const TriangleMesh& mesh);

  TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals;  ///< Of each triangle, as wound; unit length.
  bool closed =
      false;  ///< Every edge has two triangles, wound alike: then none is seen from behind.
};

/// A window of the image with the part in it.
struct RenderedPart
{
  int left = 0;                         ///< Column of the window's first pixel in the image.
  int top = 0;                          ///< Row of the window's first pixel in the image.
  int width = 0;                        ///< [px]; 0 where the part is outside the image.
  int height = 0;                       ///< [px]
  std::vector<float> depth;             ///< Row after row, along z [m]; 0 where the part is not.
  std::vector<std::uint32_t> triangle;  ///< The triangle seen; undefined where depth is 0.
  std::vector<Eigen::Vector3f>
      normals;  ///< Of each triangle drawn, camera frame, unit length, as wound.

  float depthAt(int column, int row) const
  {
    return depth[static_cast<std::size_t>(row) * width + column];
  }
};

/// Renders a mesh into a depth window by a z-buffer. Surfaces that are not closed are seen from
/// both sides. Triangles with a vertex behind the camera, or within 1 mm of it along z, are left
/// out.
/// @param T_camera_model  Mesh frame to camera frame [m].
/// @param rendered        Overwritten; its memory is used again.
void renderPart(const RenderableMesh& part, const Eigen::Isometry3f& T_camera_model,
                const PinholeCamera& camera, RenderedPart& rendered);
}  // namespace ppf_bin_picking

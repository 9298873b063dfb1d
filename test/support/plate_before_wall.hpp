/// @file A plate before a wall, as a perfect sensor sees it.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// What a perfect sensor sees of a scene: depths and the surfaces' own normals; all in the region.
inline RangeImage perfectImage(const std::vector<PlacedMesh>& scene)
{
  RangeImage image;
  image.camera = smallCamera();
  const std::size_t pixels = static_cast<std::size_t>(image.camera.width) * image.camera.height;
  image.depth.assign(pixels, 0);
  image.normals.assign(pixels, Eigen::Vector3f::Zero());
  image.in_roi.assign(pixels, 1);
  RenderedPart view;
  for (const PlacedMesh& placed : scene)
  {
    renderPart(RenderableMesh(placed.mesh), placed.T_camera_mesh.cast<float>(), image.camera, view);
    for (int row = 0; row < view.height; ++row)
      for (int column = 0; column < view.width; ++column)
      {
        const float z = view.depthAt(column, row);
        const std::size_t i = image.index(view.left + column, view.top + row);
        if (z == 0 || (image.depth[i] > 0 && image.depth[i] <= z)) continue;
        image.depth[i] = z;
        const Eigen::Vector3f& normal =
            view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
        const bool away = normal.dot(image.point(view.left + column, view.top + row)) > 0;
        image.normals[i] = away ? Eigen::Vector3f(-normal) : normal;
      }
  }
  return image;
}

/// A plate of 80 x 60 x 6 mm that looks at the camera, slanted a little, far before a wall.
class PlateBeforeWall : public ::testing::Test
{
protected:
  RangeImage freeImage() const { return perfectImage({wall(0.8), {mesh_, T_camera_plate_}}); }

  PoseEvidence evidenceIn(const RangeImage& image) const
  {
    return gatherEvidence(image, plate_, T_camera_plate_.cast<float>(), config_);
  }

  DetectorConfig config_;
  const TriangleMesh mesh_ = boxMesh({0.08F, 0.06F, 0.006F});
  const PpfModel plate_ = coarselyTrained(mesh_);
  const Eigen::Isometry3d T_camera_plate_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6}) * poseOf(0.1, {1, 2, 0}, {0, 0, 0});
};
}  // namespace ppf_bin_picking

/// @file Clouds of posed meshes, and random poses.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/normals.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include "support/shapes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
/// A mesh and where it is.
struct PlacedMesh
{
  TriangleMesh mesh;
  Eigen::Isometry3d T_camera_mesh = Eigen::Isometry3d::Identity();  ///< [m]
};

/// A wall of 2 x 2 m that faces the camera.
inline PlacedMesh wall(double z_m)
{
  PlacedMesh placed = {squareMesh(1.0F)};
  placed.T_camera_mesh.translate(Eigen::Vector3d(0, 0, z_m))
      .rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  return placed;
}

/// A model with few samples, for tests that vote for nothing.
inline PpfModel coarselyTrained(const TriangleMesh& mesh,
                                const SymmetryGroup& symmetries = SymmetryGroup())
{
  ModelParameters coarse;
  coarse.step_rel = 0.2;
  return PpfModel::train(mesh, symmetries, coarse);
}

/// A camera of 320 x 240 pixels that sees 0.32 m x 0.24 m at 0.6 m.
inline PinholeCamera smallCamera()
{
  return {320, 240, 600, 600, 159.5F, 119.5F};
}

/// Turn about an axis, then shift.
inline Eigen::Isometry3d poseOf(double angle_rad, const Eigen::Vector3d& axis,
                                const Eigen::Vector3d& shift_m)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  pose.translation() = shift_m;
  return pose;
}

/// Uniform orientation, each coordinate of the shift within +-reach_m.
inline Eigen::Isometry3d randomPose(std::mt19937& rng, double reach_m)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> shift(-reach_m, reach_m);
  const Eigen::Quaterniond turn(normal(rng), normal(rng), normal(rng), normal(rng));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(shift(rng), shift(rng), shift(rng));
  return pose;
}

inline Eigen::Vector3f randomPoint(std::mt19937& rng, float reach_m)
{
  std::uniform_real_distribution<float> coordinate(-reach_m, reach_m);
  const float x = coordinate(rng), y = coordinate(rng);
  return {x, y, coordinate(rng)};
}

inline Eigen::Vector3f randomDirection(std::mt19937& rng)
{
  std::normal_distribution<float> normal;
  const float x = normal(rng), y = normal(rng);
  return Eigen::Vector3f(x, y, normal(rng)).normalized();
}

/// Depth along z [m] that the camera measures at each pixel; 0 where it sees nothing.
inline std::vector<float> renderDepth(const std::vector<PlacedMesh>& scene,
                                      const PinholeCamera& camera)
{
  std::vector<float> depth(static_cast<std::size_t>(camera.width) * camera.height, 0.0F);
  RenderedPart view;
  for (const PlacedMesh& placed : scene)
  {
    renderPart(RenderableMesh(placed.mesh), placed.T_camera_mesh.cast<float>(), camera, view);
    for (int row = 0; row < view.height; ++row)
      for (int column = 0; column < view.width; ++column)
      {
        const float z = view.depthAt(column, row);
        float& nearest =
            depth[static_cast<std::size_t>(view.top + row) * camera.width + view.left + column];
        if (z > 0 && (nearest == 0 || z < nearest)) nearest = z;
      }
  }
  return depth;
}

/// What smallCamera() measures of a scene, with normals; all of it in the region.
/// @param depth_gate_m  See estimateImageNormals().
/// @param noise_m       Standard deviation of the depth.
inline RangeImage imageOf(const std::vector<PlacedMesh>& scene, float depth_gate_m,
                          float noise_m = 0, std::uint32_t seed = 1)
{
  RangeImage image;
  image.camera = smallCamera();
  image.depth = renderDepth(scene, image.camera);
  std::mt19937 rng(seed);
  std::normal_distribution<float> noise;
  for (float& z : image.depth)
    if (z > 0) z += noise_m * noise(rng);
  image.in_roi.assign(image.depth.size(), 1);
  estimateImageNormals(image, 2, depth_gate_m, 1);
  return image;
}

/// The organised cloud of a scene, NaN where the camera sees nothing.
/// @param noise_m  Standard deviation along z.
inline PointCloud renderCloud(const std::vector<PlacedMesh>& scene, const PinholeCamera& camera,
                              float noise_m = 0)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> depth = renderDepth(scene, camera);
  std::mt19937 rng(11);
  std::normal_distribution<float> noise;
  PointCloud cloud;
  cloud.width = static_cast<std::size_t>(camera.width);
  cloud.height = static_cast<std::size_t>(camera.height);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
    {
      const float z = depth[cloud.points.size()];
      const Eigen::Vector3f ray = camera.ray(static_cast<float>(u), static_cast<float>(v));
      cloud.points.push_back(z > 0 ? Eigen::Vector3f(ray * (z + noise_m * noise(rng)))
                                   : Eigen::Vector3f(kNan, kNan, kNan));
    }
  return cloud;
}

/// The measured points of a cloud without their order.
inline PointCloud shuffledCloud(const PointCloud& cloud)
{
  PointCloud shuffled;
  std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(shuffled.points),
               [](const Eigen::Vector3f& p) { return p.allFinite(); });
  std::shuffle(shuffled.points.begin(), shuffled.points.end(), std::mt19937(5));
  shuffled.width = shuffled.points.size();
  shuffled.height = 1;
  return shuffled;
}

/// Angle between two orientations [rad].
inline double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}
}  // namespace ppf_bin_picking

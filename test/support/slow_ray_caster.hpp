/// @file A slow and obvious ray caster: every ray against every triangle, in double precision.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// Where a ray meets a triangle.
struct SlowHit
{
  double distance = 0;  ///< In lengths of the ray's direction; along z [m] for PinholeCamera::ray.
  std::size_t triangle = 0;
};

/// All triangles that a ray meets before it, in their order, whichever side they show.
inline std::vector<SlowHit> slowHits(const TriangleMesh& mesh, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction)
{
  std::vector<SlowHit> hits;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Eigen::Vector3d a = mesh.vertices[ia].cast<double>();
    Eigen::Matrix3d system;  // a + s (b - a) + t (c - a) = origin + distance * direction
    system.col(0) = mesh.vertices[ib].cast<double>() - a;
    system.col(1) = mesh.vertices[ic].cast<double>() - a;
    system.col(2) = -direction;
    if (system.determinant() == 0) continue;
    const Eigen::Vector3d solution = system.inverse() * (origin - a);
    const double s = solution.x(), t = solution.y();
    if (s >= 0 && t >= 0 && s + t <= 1 && solution.z() > 0) hits.push_back({solution.z(), i});
  }
  return hits;
}

/// The nearest of them.
inline std::optional<SlowHit> slowNearestHit(const TriangleMesh& mesh,
                                             const Eigen::Vector3d& origin,
                                             const Eigen::Vector3d& direction)
{
  std::optional<SlowHit> nearest;
  for (const SlowHit& hit : slowHits(mesh, origin, direction))
    if (!nearest || hit.distance < nearest->distance) nearest = hit;
  return nearest;
}

/// True if a point lies inside a closed mesh: a ray from it meets an odd number of triangles.
inline bool slowIsInside(const TriangleMesh& mesh, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d anywhere(0.3141, 0.2718,
                                 0.9093);  // meets no edge of a mesh with round numbers
  return slowHits(mesh, point, anywhere).size() % 2 == 1;
}

/// The mesh at a pose.
inline TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& T_to_mesh)
{
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (T_to_mesh * vertex.cast<double>()).cast<float>();
  return mesh;
}
}  // namespace ppf_bin_picking

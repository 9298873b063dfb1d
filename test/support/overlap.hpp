/// @file How deep parts get into each other and into their bin, measured on their meshes the slow
/// way.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/bin.hpp"
#include "ppf_bin_picking/sim/random.hpp"
#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ppf_bin_picking
{
/// A mesh's corners and about one random point for each square of side spacing_m of its surface.
inline std::vector<Eigen::Vector3f> surfacePoints(const TriangleMesh& mesh, float spacing_m)
{
  std::vector<Eigen::Vector3f> points = mesh.vertices;
  Random random(2);
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3f a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]],
                          c = mesh.vertices[triangle[2]];
    const float share = (b - a).cross(c - a).norm() / 2 / (spacing_m * spacing_m);
    for (int sample = 0; sample < static_cast<int>(std::ceil(share)); ++sample)
    {
      const Eigen::Vector3f weight = random.direction().cwiseAbs2().cast<float>();  // adds up to 1
      points.push_back(weight.x() * a + weight.y() * b + weight.z() * c);
    }
  }
  return points;
}

/// A closed mesh that tells how deep points lie in it.
class Solid
{
public:
  /// Keeps a reference to the mesh.
  explicit Solid(const TriangleMesh& mesh)
      : mesh_(mesh), caster_({{&mesh, Eigen::Isometry3d::Identity()}})
  {
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      box_.extend(vertex);
  }

  /// Distance [m] to the nearest point of the surface, of all its triangles; 0 outside. A point is
  /// inside if most of five rays leave more often than they enter.
  double depth(const Eigen::Vector3f& point) const
  {
    if (!box_.contains(point)) return 0;
    Random random(3);
    int inside = 0;
    for (int ray = 0; ray < 5; ++ray)
      if (balance(point, random.direction().cast<float>()) > 0) ++inside;
    if (inside < 3) return 0;
    float nearest = std::numeric_limits<float>::infinity();
    for (const auto& triangle : mesh_.triangles)
      nearest = std::min(nearest, distance(triangle, point));
    return nearest;
  }

private:
  /// Surfaces left less surfaces entered along a ray.
  int balance(Eigen::Vector3f origin, const Eigen::Vector3f& direction) const
  {
    int left = 0;
    for (int crossing = 0; crossing < 100; ++crossing)
    {
      const auto hit = caster_.cast(origin, direction);
      if (!hit) break;
      left += hit->normal.dot(direction) > 0 ? 1 : -1;
      origin += (hit->distance_m + 1e-6F) * direction;
    }
    return left;
  }

  /// Of a point to a triangle: to its plane if it lies over the triangle, else to its sides.
  float distance(const std::array<std::uint32_t, 3>& triangle, const Eigen::Vector3f& point) const
  {
    const Eigen::Vector3f corners[3] = {mesh_.vertices[triangle[0]], mesh_.vertices[triangle[1]],
                                        mesh_.vertices[triangle[2]]};
    const Eigen::Vector3f normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    bool over = true;
    float to_sides = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3f side = corners[(k + 1) % 3] - corners[k];
      const Eigen::Vector3f to_point = point - corners[k];
      if (normal.cross(side).dot(to_point) < 0) over = false;
      const float share = std::clamp(side.dot(to_point) / side.squaredNorm(), 0.0F, 1.0F);
      to_sides = std::min(to_sides, (to_point - share * side).norm());
    }
    return over ? std::abs(normal.dot(point - corners[0])) : to_sides;
  }

  const TriangleMesh& mesh_;
  RayCaster caster_;
  Eigen::AlignedBox3f box_;
};

/// For each part, how deep [m] the deepest of its surface points lies in another part or in the
/// bin's floor or walls.
inline std::vector<double> deepestOverlaps(const Bin& bin, const TriangleMesh& part,
                                           const std::vector<Eigen::Isometry3d>& T_bin_part,
                                           float spacing_m)
{
  const TriangleMesh bin_mesh = binMesh(bin);
  const Solid bin_solid(bin_mesh);
  const Solid solid(part);
  const auto points = surfacePoints(part, spacing_m);
  double reach = 0;
  for (const Eigen::Vector3f& vertex : part.vertices)
    reach = std::max(reach, static_cast<double>(vertex.norm()));
  std::vector<double> deepest;
  for (const Eigen::Isometry3d& one : T_bin_part)
  {
    double depth = 0;
    for (const Eigen::Vector3f& point : points)
      depth = std::max(depth, bin_solid.depth(one.cast<float>() * point));
    for (const Eigen::Isometry3d& other : T_bin_part)
    {
      if (&one == &other || (one.translation() - other.translation()).norm() > 2 * reach) continue;
      const Eigen::Isometry3f T_other_one = (other.inverse() * one).cast<float>();
      for (const Eigen::Vector3f& point : points)
        depth = std::max(depth, solid.depth(T_other_one * point));
    }
    deepest.push_back(depth);
  }
  return deepest;
}

/// The furthest that a point of the part moves between two poses [m].
inline double furthestMove(const TriangleMesh& part, const Eigen::Isometry3d& from,
                           const Eigen::Isometry3d& to)
{
  double furthest = 0;
  for (const Eigen::Vector3f& vertex : part.vertices)
    furthest =
        std::max(furthest, (from * vertex.cast<double>() - to * vertex.cast<double>()).norm());
  return furthest;
}
}  // namespace ppf_bin_picking

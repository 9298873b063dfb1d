/// @file What can be said about a mesh by looking at each of its triangles: slow and obvious.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// Corners of a triangle as columns [m].
inline Eigen::Matrix3d corners(const TriangleMesh& mesh, std::size_t triangle)
{
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k)
    result.col(k) = mesh.vertices[mesh.triangles[triangle][k]].cast<double>();
  return result;
}

/// Normal as wound, twice as long as the triangle is large.
inline Eigen::Vector3d areaNormal(const Eigen::Matrix3d& corners)
{
  return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
}

/// True if each edge is used once in each direction: closed, and wound alike all over.
inline bool closedAndWoundAlike(const TriangleMesh& mesh)
{
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (!edges.emplace(t[k], t[(k + 1) % 3]).second) return false;
  return std::all_of(edges.begin(), edges.end(),
                     [&](const auto& edge) {
                       return edges.count({edge.second, edge.first}) == 1;
                     });
}

/// Volume [m^3], negative if wound inwards, and centre of mass [m] of a closed mesh.
inline std::pair<double, Eigen::Vector3d> volumeAndCenter(const TriangleMesh& mesh)
{
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const Eigen::Matrix3d c = corners(mesh, i);
    volume += c.determinant() / 6;
    moment += c.determinant() / 6 * c.rowwise().sum() / 4;
  }
  return {volume, moment / volume};
}

/// Points spread over the surface, as many to each square metre [m].
inline std::vector<Eigen::Vector3d> spreadPoints(const TriangleMesh& mesh, int count)
{
  std::vector<double> areas;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    areas.push_back(areaNormal(corners(mesh, i)).norm());
  std::mt19937 rng(1);
  std::discrete_distribution<std::size_t> triangle(areas.begin(), areas.end());
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Matrix3d c = corners(mesh, triangle(rng));
    const double a = std::sqrt(uniform(rng)), b = uniform(rng);
    points.emplace_back((1 - a) * c.col(0) + a * (1 - b) * c.col(1) + a * b * c.col(2));
  }
  return points;
}

/// Distance of a point to a triangle [m]: to its plane if the point lies above it, else to its
/// edges.
inline double triangleDistance(const Eigen::Matrix3d& corners, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d normal = areaNormal(corners).normalized();
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d start = corners.col(k);
    const Eigen::Vector3d edge = corners.col((k + 1) % 3) - start;
    above = above && normal.cross(edge).dot(point - start) >= 0;
    const double share = std::clamp((point - start).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (start + share * edge - point).norm());
  }
  return above ? std::abs(normal.dot(point - corners.col(0))) : nearest;
}

/// Distance of a point to the surface [m].
inline double surfaceDistance(const TriangleMesh& mesh, const Eigen::Vector3d& point)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    nearest = std::min(nearest, triangleDistance(corners(mesh, i), point));
  return nearest;
}

/// Where a line meets the surface.
struct LineHit
{
  double along_m = 0;                                ///< From the line's origin; negative: behind.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Unit length, as wound.
};

/// All places where a line meets the surface; on an edge, once for each of its triangles.
/// @param direction  Unit length.
inline std::vector<LineHit> lineHits(const TriangleMesh& mesh, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction)
{
  std::vector<LineHit> hits;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const Eigen::Matrix3d c = corners(mesh, i);
    Eigen::Matrix3d system;
    system << c.col(1) - c.col(0), c.col(2) - c.col(0), -direction;
    const Eigen::Vector3d normal = areaNormal(c).normalized();
    if (std::abs(normal.dot(direction)) < 1e-6) continue;  // runs along the triangle
    const Eigen::Vector3d uvt = system.inverse() * (origin - c.col(0));
    constexpr double kEdge = -1e-9;
    if (uvt.x() >= kEdge && uvt.y() >= kEdge && uvt.x() + uvt.y() <= 1 - kEdge)
      hits.push_back({uvt.z(), normal});
  }
  return hits;
}
}  // namespace ppf_bin_picking

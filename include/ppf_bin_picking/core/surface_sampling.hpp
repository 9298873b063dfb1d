/// @file Oriented points on surfaces: uniform on a mesh, thinned out on a grid.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Points [m] with unit normals, one for one.
struct OrientedPoints
{
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;

  std::size_t size() const { return points.size(); }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
  {
    points.push_back(point);
    normals.push_back(normal);
  }
};

/// The largest distance between two vertices [m]; 0 without vertices. With more than 2000 of them
/// up to half a per mille less, since only those farthest out in some direction are compared.
float meshDiameter(const TriangleMesh& mesh);

/// Centre of a sphere around all vertices, within a per mille of the smallest one's radius [m].
Eigen::Vector3f boundingSphereCenter(const TriangleMesh& mesh);

/// A point on a mesh.
struct MeshSample
{
  Eigen::Vector3f point;   ///< [m]
  std::uint32_t triangle;  ///< The triangle it lies on.
};

/// Samples all of a mesh uniformly by area, at most 400000 points: each triangle gets its share,
/// laid out by a low-discrepancy sequence. In the order of the triangles.
/// @param spacing_m  Distance of neighbouring samples, about.
std::vector<MeshSample> sampleTriangles(const TriangleMesh& mesh, float spacing_m);

/// Samples the outside of a mesh uniformly by area. A point counts as outside if one of many
/// viewpoints around the part sees it; its normal points to the side it is seen from, whatever the
/// winding says. Where a mesh is not closed and its back is seen from more than a quarter as many
/// viewpoints as its front, as of a sheet, it yields points on both sides.
/// @param mesh       Metres; closed or not. Triangles seen from behind alone are turned round.
/// @param spacing_m  Distance of neighbouring samples, about.
OrientedPoints sampleVisibleSurface(TriangleMesh& mesh, float spacing_m);

/// Thins out points to one a cell of a cubic grid and normal direction: points of a cell whose
/// normals lie within 30 degrees of the first of a direction become their mean. Ordered by cell.
/// The order of the input decides which normal is the first of a direction, and nothing else but
/// rounding.
OrientedPoints thinOut(const OrientedPoints& cloud, float cell_m);
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/ros/simplified_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::TriangleMesh;
using Triangle = std::array<std::uint32_t, 3>;

/// The triangle with its smallest index first and its winding kept, so that equal ones compare so.
Triangle rotatedToSmallest(Triangle triangle)
{
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

TriangleMesh mergedByGrid(const TriangleMesh& mesh, const float cell_m)
{
  TriangleMesh merged;
  std::map<std::array<int, 3>, std::uint32_t> vertex_of_cell;
  std::vector<std::uint32_t> new_index(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
  {
    const Eigen::Array3i cell = (mesh.vertices[i] / cell_m).array().floor().cast<int>();
    const auto next = static_cast<std::uint32_t>(merged.vertices.size());
    const auto [found, added] = vertex_of_cell.insert({{cell.x(), cell.y(), cell.z()}, next});
    if (added) merged.vertices.push_back(mesh.vertices[i]);
    new_index[i] = found->second;
  }
  std::set<Triangle> seen;
  for (const Triangle& old : mesh.triangles)
  {
    const Triangle triangle = {new_index[old[0]], new_index[old[1]], new_index[old[2]]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    if (seen.insert(rotatedToSmallest(triangle)).second) merged.triangles.push_back(triangle);
  }
  return merged;
}
}  // namespace

TriangleMesh simplifiedMesh(const TriangleMesh& mesh, const std::size_t max_triangles)
{
  if (mesh.triangles.size() <= max_triangles) return mesh;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    box.extend(vertex);
  constexpr float kFinestGrid = 512;  // cells along the box's diagonal
  constexpr float kCoarser = 1.25F;
  float cell_m = std::max(box.diagonal().norm(), 1e-6F) / kFinestGrid;
  TriangleMesh merged = mergedByGrid(mesh, cell_m);
  while (merged.triangles.size() > max_triangles)
    merged = mergedByGrid(mesh, cell_m *= kCoarser);
  return merged;
}
}  // namespace ppf_bin_picking_ros

#include "convex_hull.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr double kUnit_m = 0.01;  // the hull is computed in these, as single precision asks for
constexpr btScalar kMostShrink = 0.4F;  // of the inner radius

/// A face as a fan of triangles.
void addFace(const btConvexHullComputer& computer, int face, TriangleMesh& mesh)
{
  const btConvexHullComputer::Edge* const first = &computer.edges[face];
  const auto corner = static_cast<std::uint32_t>(first->getSourceVertex());
  for (const auto* edge = first->getNextEdgeOfFace(); edge != first;
       edge = edge->getNextEdgeOfFace())
  {
    const auto a = static_cast<std::uint32_t>(edge->getSourceVertex());
    const auto b = static_cast<std::uint32_t>(edge->getTargetVertex());
    if (a != corner && b != corner) mesh.triangles.push_back({corner, a, b});
  }
}

/// How far a point lies outside a hull: over the face that it exceeds most; negative inside.
double excess(const TriangleMesh& hull, const std::vector<Eigen::Vector3d>& normals,
              const Eigen::Vector3d& point)
{
  double most = -1;
  for (std::size_t t = 0; t < normals.size(); ++t)
    most = std::max(most, normals[t].dot(point - hull.vertices[hull.triangles[t][0]].cast<double>()));
  return most;
}

std::vector<Eigen::Vector3d> unitNormals(const TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3d> normals;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d corner = mesh.vertices[a].cast<double>();
    normals.push_back((mesh.vertices[b].cast<double>() - corner)
                          .cross(mesh.vertices[c].cast<double>() - corner)
                          .normalized());
  }
  return normals;
}

/// The points that reach furthest along a few directions.
Points extremes(const Points& points)
{
  Points found;
  for (int direction = 0; direction < 26; ++direction)
  {
    const int code = direction < 13 ? direction : direction + 1;  // 13 is no direction
    const Eigen::Vector3d along(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    const auto lower = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
    { return a.dot(along) < b.dot(along); };
    const Eigen::Vector3d& furthest = *std::max_element(points.begin(), points.end(), lower);
    if (std::find(found.begin(), found.end(), furthest) == found.end()) found.push_back(furthest);
  }
  return found;
}
}  // namespace

double enclosedVolume(const TriangleMesh& mesh)
{
  double volume = 0;
  for (const auto& triangle : mesh.triangles)
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = mesh.vertices[triangle[k]].cast<double>();
    volume += corners.determinant() / 6;
  }
  return volume;
}

ConvexHull convexHull(const Points& points, double shrink_m)
{
  ConvexHull hull;
  if (points.size() < 4) return hull;
  Points scaled = points;
  for (Eigen::Vector3d& point : scaled)
    point /= kUnit_m;
  btConvexHullComputer computer;
  const auto shrunk = computer.compute(scaled.front().data(), sizeof scaled[0],
                                       static_cast<int>(scaled.size()),
                                       static_cast<btScalar>(shrink_m / kUnit_m), kMostShrink);
  if (shrunk < 0) return hull;
  hull.shrunk_m = shrunk * kUnit_m;
  for (int k = 0; k < computer.vertices.size(); ++k)
  {
    const btVector3& vertex = computer.vertices[k];
    hull.mesh.vertices.push_back(Eigen::Vector3d(vertex.x(), vertex.y(), vertex.z()).cast<float>() *
                                 static_cast<float>(kUnit_m));
  }
  for (int k = 0; k < computer.faces.size(); ++k)
    addFace(computer, computer.faces[k], hull.mesh);
  hull.volume = enclosedVolume(hull.mesh);
  if (hull.volume < 0)
    for (auto& triangle : hull.mesh.triangles)
      std::swap(triangle[1], triangle[2]);
  hull.volume = std::abs(hull.volume);
  return hull;
}

ConvexHull simplifiedHull(const Points& points, double tolerance_m, std::size_t most)
{
  Points chosen = extremes(points);
  ConvexHull hull = convexHull(chosen);
  while (chosen.size() < most)
  {
    const std::vector<Eigen::Vector3d> normals = unitNormals(hull.mesh);
    double worst = tolerance_m;
    const Eigen::Vector3d* missed = nullptr;
    for (const Eigen::Vector3d& point : points)
    {
      const double beyond = excess(hull.mesh, normals, point);
      if (beyond <= worst) continue;
      worst = beyond;
      missed = &point;
    }
    if (missed == nullptr) break;
    chosen.push_back(*missed);
    hull = convexHull(chosen);
  }
  return hull;
}
}  // namespace ppf_bin_picking

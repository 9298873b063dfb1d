#include "void_search.hpp"

#include "triangle_points.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace ppf_bin_picking
{
namespace
{
constexpr int kMostCrossings = 64;  // of a ray and the surface
}

VoidSearch::VoidSearch(const TriangleMesh& part, double spacing_m)
    : part_(part), spacing_m_(spacing_m), caster_({{&part, Eigen::Isometry3d::Identity()}})
{
  for (const auto& triangle : part.triangles)
  {
    const Triangle corners = cornersOf(part, triangle);
    const Eigen::Vector3d center = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Eigen::Vector3d& corner : corners)
      radius = std::max(radius, (corner - center).norm());
    centers_.push_back(center);
    radii_.push_back(radius);
  }
}

int VoidSearch::shellsAround(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const
{
  int shells = 0;
  Eigen::Vector3f origin = point;
  for (int crossing = 0; crossing < kMostCrossings; ++crossing)
  {
    const auto hit = caster_.cast(origin, direction);
    if (!hit) break;
    shells += hit->normal.dot(direction) > 0 ? 1 : -1;
    origin += (hit->distance_m + static_cast<float>(1e-4 * spacing_m_)) * direction;
  }
  return shells;
}

bool VoidSearch::isInside(const Eigen::Vector3d& point) const
{
  // No axis of symmetry of a usual part, so that a ray hardly ever runs along an edge.
  static const Eigen::Vector3f kDirections[] = {
      {0.48F, 0.6F, 0.64F}, {-0.64F, 0.48F, -0.6F}, {0.6F, -0.64F, -0.48F}};
  int inside = 0;
  for (const Eigen::Vector3f& direction : kDirections)
    if (shellsAround(point.cast<float>(), direction) > 0) ++inside;
  return inside >= 2;
}

VoidPoint VoidSearch::nearestSurface(const Eigen::Vector3d& point) const
{
  VoidPoint found;
  found.position = point;
  found.depth_m = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < centers_.size(); ++t)
  {
    const double reach = found.depth_m + radii_[t];
    if ((centers_[t] - point).squaredNorm() >= reach * reach) continue;
    const Triangle corners = cornersOf(part_, part_.triangles[t]);
    const Eigen::Vector3d candidate = nearestOnTriangle(corners, point);
    const double distance = (candidate - point).norm();
    if (distance >= found.depth_m) continue;
    found.depth_m = distance;
    found.nearest = candidate;
    found.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  }
  return found;
}

std::vector<VoidPoint> VoidSearch::voids(const TriangleMesh& hull, double least_m) const
{
  std::vector<VoidPoint> found;
  for (const auto& triangle : hull.triangles)
    for (const Eigen::Vector3d& point : spreadPoints(cornersOf(hull, triangle), spacing_m_))
    {
      if (isInside(point)) continue;
      const VoidPoint candidate = nearestSurface(point);
      if (candidate.depth_m > least_m) found.push_back(candidate);
    }
  const auto deeper = [](const VoidPoint& a, const VoidPoint& b) { return a.depth_m > b.depth_m; };
  std::stable_sort(found.begin(), found.end(), deeper);
  return found;
}
}  // namespace ppf_bin_picking

#include "triangle_points.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
Eigen::Vector3d nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& point)
{
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  if (!(length2 > 0)) return a;
  return a + std::clamp(along.dot(point - a) / length2, 0.0, 1.0) * along;
}
}  // namespace

Triangle cornersOf(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle)
{
  return {mesh.vertices[triangle[0]].cast<double>(), mesh.vertices[triangle[1]].cast<double>(),
          mesh.vertices[triangle[2]].cast<double>()};
}

Eigen::Vector3d nearestOnTriangle(const Triangle& triangle, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d ab = triangle[1] - triangle[0];
  const Eigen::Vector3d ac = triangle[2] - triangle[0];
  const Eigen::Vector3d ap = point - triangle[0];
  const double bb = ab.dot(ab), bc = ab.dot(ac), cc = ac.dot(ac);
  const double bp = ab.dot(ap), cp = ac.dot(ap);
  const double scale = bb * cc - bc * bc;
  if (scale > 0)
  {
    const double v = (cc * bp - bc * cp) / scale;
    const double w = (bb * cp - bc * bp) / scale;
    if (v >= 0 && w >= 0 && v + w <= 1) return triangle[0] + v * ab + w * ac;
  }
  Eigen::Vector3d best = nearestOnSegment(triangle[0], triangle[1], point);
  for (int side = 1; side < 3; ++side)
  {
    const Eigen::Vector3d other =
        nearestOnSegment(triangle[side], triangle[(side + 1) % 3], point);
    if ((other - point).squaredNorm() < (best - point).squaredNorm()) best = other;
  }
  return best;
}

std::vector<Eigen::Vector3d> spreadPoints(const Triangle& triangle, double spacing_m)
{
  double longest = 0;
  for (int side = 0; side < 3; ++side)
    longest = std::max(longest, (triangle[side] - triangle[(side + 1) % 3]).norm());
  const int cells = std::max(1, static_cast<int>(std::ceil(longest / spacing_m)));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; i + j < cells; ++j)
    {
      const double v = (i + 1.0 / 3) / cells;
      const double w = (j + 1.0 / 3) / cells;
      points.push_back((1 - v - w) * triangle[0] + v * triangle[1] + w * triangle[2]);
    }
  return points;
}
}  // namespace ppf_bin_picking

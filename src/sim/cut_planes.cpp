#include "cut_planes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDirectionStep = 0.05;  // of unit normals: nearer ones are of one face

/// Adds what lies on the side that the plane's normal points to.
void addClipped(const Triangle& triangle, const Plane& plane, std::vector<Triangle>& kept)
{
  std::vector<Eigen::Vector3d> polygon;
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d& a = triangle[k];
    const Eigen::Vector3d& b = triangle[(k + 1) % 3];
    const double over_a = plane.normal.dot(a) - plane.offset;
    const double over_b = plane.normal.dot(b) - plane.offset;
    if (over_a >= 0) polygon.push_back(a);
    if ((over_a > 0 && over_b < 0) || (over_a < 0 && over_b > 0))
      polygon.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  for (std::size_t k = 2; k < polygon.size(); ++k)
    kept.push_back({polygon[0], polygon[k - 1], polygon[k]});
}
}  // namespace

std::vector<Triangle> clipped(const std::vector<Triangle>& surface, const Plane& plane)
{
  std::vector<Triangle> kept;
  for (const Triangle& triangle : surface)
    addClipped(triangle, plane, kept);
  return kept;
}

std::vector<Plane> flatFaces(const std::vector<Triangle>& surface, double offset_step_m,
                             std::size_t most)
{
  std::map<std::array<int, 4>, std::pair<double, Plane>> faces;  // by direction and offset, rounded
  for (const Triangle& triangle : surface)
  {
    const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const Eigen::Vector3d normal = across.normalized();
    const double offset = normal.dot(triangle[0]);
    std::array<int, 4> key = {0, 0, 0, static_cast<int>(std::lround(offset / offset_step_m))};
    for (int axis = 0; axis < 3; ++axis)
      key[axis] = static_cast<int>(std::lround(normal[axis] / kDirectionStep));
    auto& [area, plane] = faces[key];
    area += across.norm() / 2;
    plane = {normal, offset};
  }
  std::vector<std::pair<double, Plane>> sorted;
  for (const auto& [key, face] : faces)
    sorted.push_back(face);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Plane> planes;
  for (std::size_t k = 0; k < std::min(most, sorted.size()); ++k)
    planes.push_back(sorted[k].second);
  return planes;
}
}  // namespace ppf_bin_picking

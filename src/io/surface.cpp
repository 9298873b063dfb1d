#include "surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
using Triangle = std::array<std::uint32_t, 3>;
constexpr double kNoArea = 1e-9;  // of twice the area, relative to the longest edge squared

/// Gives equal positions one index, in order of first use.
class VertexMerger
{
public:
  explicit VertexMerger(std::vector<Eigen::Vector3f>& vertices) : vertices_(vertices) {}

  std::uint32_t index(const Eigen::Vector3f& position)
  {
    const Eigen::Vector3f p = position + Eigen::Vector3f::Zero();  // -0 becomes 0
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [entry, is_new] = index_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new) vertices_.push_back(p);
    return entry->second;
  }

private:
  std::vector<Eigen::Vector3f>& vertices_;
  std::map<std::array<float, 3>, std::uint32_t> index_;
};

/// Twice the area's vector, zero if the corners lie on one line.
Eigen::Vector3d areaVector(const std::array<Eigen::Vector3f, 3>& corners)
{
  const Eigen::Vector3d a = (corners[1] - corners[0]).cast<double>();
  const Eigen::Vector3d b = (corners[2] - corners[0]).cast<double>();
  const Eigen::Vector3d area = a.cross(b);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  return area.norm() > kNoArea * longest ? area : Eigen::Vector3d::Zero();
}

/// The same triangle has the same smallest-first form, another winding another.
Triangle smallestFirst(Triangle t)
{
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::size_t countOpenEdges(const std::vector<Triangle>& triangles)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> odd;
  for (const Triangle& t : triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      bool& is_odd = odd[std::minmax(t[k], t[(k + 1) % 3])];
      is_odd = !is_odd;
    }
  }
  return static_cast<std::size_t>(
      std::count_if(odd.begin(), odd.end(), [](const auto& edge) { return edge.second; }));
}

double longestSide(const std::vector<Eigen::Vector3f>& vertices)
{
  if (vertices.empty()) return 0;
  Eigen::Vector3f low = vertices.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& v : vertices)
  {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high.cast<double>() - low.cast<double>()).maxCoeff();
}
}  // namespace

std::vector<std::string> CleanSurface::oddities(bool normals_matter) const
{
  std::vector<std::string> texts;
  const auto add = [&](std::size_t count, const std::string& text)
  {
    if (count > 0) texts.push_back(text);
  };
  const auto share = [&](std::size_t count)
  { return std::to_string(count) + " of " + std::to_string(all) + " triangles "; };
  add(not_finite, "has " + share(not_finite) +
                      "with a coordinate that is no finite number; they "
                      "are left out");
  add(without_area, "has " + share(without_area) + "without area; they are left out");
  add(repeated, "has " + share(repeated) + "twice; the copies are left out");
  add(normals_matter ? contrary_normals : 0,
      "states for " + share(contrary_normals) +
          "a normal that is missing, not finite or not that of the corners; normals are computed");
  add(open_edges, "is not closed (" + std::to_string(open_edges) +
                      " edges belong to one triangle only): if the part has no hole there, a piece "
                      "of its surface is missing");
  return texts;
}

CleanSurface cleaned(const RawSurface& raw, double metres_per_unit)
{
  CleanSurface clean;
  clean.all = raw.triangles.size();
  VertexMerger merger(clean.mesh.vertices);
  std::set<Triangle> known;
  for (const std::array<std::size_t, 3>& triangle : raw.triangles)
  {
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = (raw.vertices[triangle[k]].cast<double>() * metres_per_unit).cast<float>();
    const Eigen::Vector3d area = areaVector(corners);
    const bool finite = corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite();
    if (!finite) ++clean.not_finite;
    if (finite && area.isZero(0)) ++clean.without_area;
    if (!finite || area.isZero(0)) continue;
    Triangle indices{};
    for (std::size_t k = 0; k < 3; ++k)
      indices[k] = merger.index(corners[k]);
    const bool is_new = known.insert(smallestFirst(indices)).second;
    if (!is_new) ++clean.repeated;
    if (!is_new) continue;
    clean.mesh.triangles.push_back(indices);
    if (!(raw.normals[triangle[0]].cast<double>().dot(area) > 0)) ++clean.contrary_normals;
  }
  clean.open_edges = countOpenEdges(clean.mesh.triangles);
  clean.extent_m = longestSide(clean.mesh.vertices);
  return clean;
}
}  // namespace ppf_bin_picking

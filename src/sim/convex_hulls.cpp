#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include "convex_hull.hpp"
#include "triangle_points.hpp"
#include "void_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr double kGap_rel = 0.01;       // deepest gap that a hull may bridge, of the part's extent
constexpr double kSpacing_rel = 0.025;  // between the points that are looked at
constexpr double kRounding_rel = 0.002;  // by which a hull may cut corners off
constexpr double kImbalance = 0.02;      // what a cut off the middle costs, of the volumes' difference
constexpr std::size_t kMostHulls = 32;
constexpr std::size_t kMostVertices = 128;  // of a hull
constexpr std::size_t kVoidsTried = 6;      // for each cut
constexpr std::size_t kFacesTried = 16;     // for each cut
constexpr double kDirectionStep = 0.05;     // of unit normals: nearer ones are of one face

struct Plane
{
  Eigen::Vector3d normal;
  double offset = 0;  ///< normal . point of its points
};

/// What of the part lies in a convex cell. The corners of its hull are points of the part's surface
/// or corners of the cell inside the part, so that the cut faces need no triangles.
struct Piece
{
  std::vector<Triangle> surface;  ///< Of the part, inside the cell.
  std::vector<Triangle> cell;
  Points inner_corners;  ///< Of the cell.
  ConvexHull hull;
  std::vector<VoidPoint> voids;  ///< Deeper than allowed. Empty: the piece is good enough.
  double depth() const { return voids.empty() ? 0 : voids.front().depth_m; }
};

Points cornerPoints(const std::vector<Triangle>& surface)
{
  Points points;
  for (const Triangle& triangle : surface)
    points.insert(points.end(), triangle.begin(), triangle.end());
  return points;
}

Points hullPoints(const Piece& piece)
{
  Points points = cornerPoints(piece.surface);
  points.insert(points.end(), piece.inner_corners.begin(), piece.inner_corners.end());
  return points;
}

std::vector<Triangle> trianglesOf(const TriangleMesh& mesh)
{
  std::vector<Triangle> triangles;
  for (const auto& triangle : mesh.triangles)
    triangles.push_back(cornersOf(mesh, triangle));
  return triangles;
}

/// Adds what lies on the side that the plane's normal points to.
void addClipped(const Triangle& triangle, const Plane& plane, std::vector<Triangle>& kept)
{
  Points polygon;
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

std::vector<Triangle> clipped(const std::vector<Triangle>& surface, const Plane& plane)
{
  std::vector<Triangle> kept;
  for (const Triangle& triangle : surface)
    addClipped(triangle, plane, kept);
  return kept;
}

/// The axes along which a piece extends most and least.
Eigen::Matrix3d principalAxes(const TriangleMesh& hull)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& vertex : hull.vertices)
    mean += vertex.cast<double>() / static_cast<double>(hull.vertices.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& vertex : hull.vertices)
    spread += (vertex.cast<double>() - mean) * (vertex.cast<double>() - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

/// Planes of the larger flat faces of a surface, largest first.
std::vector<Plane> flatFaces(const std::vector<Triangle>& surface, double offset_step_m)
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
  for (std::size_t k = 0; k < std::min(kFacesTried, sorted.size()); ++k)
    planes.push_back(sorted[k].second);
  return planes;
}

/// Planes through or beside the deepest voids of a piece.
std::vector<Plane> cutCandidates(const Piece& piece)
{
  const Eigen::Matrix3d axes = principalAxes(piece.hull.mesh);
  std::vector<Plane> planes;
  const std::size_t step = std::max<std::size_t>(1, piece.voids.size() / kVoidsTried);
  for (std::size_t k = 0; k < piece.voids.size(); k += step)
  {
    const VoidPoint& gap = piece.voids[k];
    planes.push_back({gap.normal, gap.normal.dot(gap.nearest)});
    const Eigen::Vector3d across = (gap.position - gap.nearest).normalized();
    planes.push_back({across, across.dot(gap.nearest)});
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
      planes.push_back({unit, unit.dot(gap.position)});
      planes.push_back({unit, unit.dot(gap.nearest)});
      planes.push_back({axes.col(axis), axes.col(axis).dot(gap.position)});
    }
  }
  return planes;
}

class Decomposition
{
public:
  Decomposition(const TriangleMesh& part, double extent_m)
      : extent_m_(extent_m), search_(part, kSpacing_rel * extent_m)
  {
    Piece whole;
    whole.surface = trianglesOf(part);
    whole.hull = convexHull(cornerPoints(whole.surface));
    whole.cell = trianglesOf(whole.hull.mesh);
    whole.voids = search_.voids(whole.hull.mesh, kGap_rel * extent_m_);
    pieces_.push_back(std::move(whole));
  }

  void cutAll()
  {
    while (pieces_.size() < kMostHulls)
    {
      const auto worst =
          std::max_element(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b)
                           { return a.depth() < b.depth(); });
      if (worst->voids.empty()) return;
      Piece halves[2];
      if (cut(*worst, halves[0], halves[1]))
      {
        *worst = std::move(halves[0]);
        pieces_.push_back(std::move(halves[1]));
      }
      else
        worst->voids.clear();  // as good as it gets
    }
  }

  /// Joins pieces whose common hull is good enough.
  void joinAll()
  {
    for (std::size_t a = 0; a < pieces_.size(); ++a)
      for (std::size_t b = a + 1; b < pieces_.size();)
        if (join(pieces_[a], pieces_[b]))
        {
          pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(b));
          b = a + 1;
        }
        else
          ++b;
  }

  ConvexHulls hulls() const
  {
    ConvexHulls result;
    for (const Piece& piece : pieces_)
    {
      TriangleMesh mesh =
          simplifiedHull(hullPoints(piece), kRounding_rel * extent_m_, kMostVertices).mesh;
      if (!mesh.triangles.empty()) result.push_back(std::move(mesh));
    }
    return result;
  }

private:
  /// The side of a piece that the plane's normal points to, its voids not yet known.
  Piece half(const Piece& piece, const Plane& plane) const
  {
    Piece result;
    result.surface = clipped(piece.surface, plane);
    if (result.surface.empty()) return result;
    result.cell = trianglesOf(convexHull(cornerPoints(clipped(piece.cell, plane))).mesh);
    for (const Eigen::Vector3d& corner : cornerPoints(result.cell))
      if (search_.isInside(corner)) result.inner_corners.push_back(corner);
    result.hull = convexHull(hullPoints(result));
    return result;
  }

  /// The cut that leaves the hulls with the least volume, near the middle where there is a choice.
  bool cut(const Piece& piece, Piece& upper, Piece& lower) const
  {
    double least = std::numeric_limits<double>::infinity();
    std::vector<Plane> planes = cutCandidates(piece);
    const std::vector<Plane> faces = flatFaces(piece.surface, kRounding_rel * extent_m_);
    planes.insert(planes.end(), faces.begin(), faces.end());
    for (const Plane& plane : planes)
    {
      Piece above = half(piece, plane);
      Piece below = half(piece, {-plane.normal, -plane.offset});
      const double smaller = std::min(above.hull.volume, below.hull.volume);
      if (!(smaller > 1e-4 * piece.hull.volume)) continue;
      const double cost = above.hull.volume + below.hull.volume +
                          kImbalance * std::abs(above.hull.volume - below.hull.volume);
      if (cost >= least) continue;
      least = cost;
      upper = std::move(above);
      lower = std::move(below);
    }
    if (upper.surface.empty()) return false;
    for (Piece* side : {&upper, &lower})
      side->voids = search_.voids(side->hull.mesh, kGap_rel * extent_m_);
    return true;
  }

  bool join(Piece& a, const Piece& b) const
  {
    Piece both;
    both.surface = a.surface;
    both.surface.insert(both.surface.end(), b.surface.begin(), b.surface.end());
    both.inner_corners = a.inner_corners;
    both.inner_corners.insert(both.inner_corners.end(), b.inner_corners.begin(), b.inner_corners.end());
    both.hull = convexHull(hullPoints(both));
    const double apart = a.hull.volume + b.hull.volume;
    if (both.hull.volume > 1.05 * apart) return false;
    both.voids = search_.voids(both.hull.mesh, kGap_rel * extent_m_);
    if (both.depth() > std::max(a.depth(), b.depth())) return false;
    a = std::move(both);
    return true;
  }

  double extent_m_;
  VoidSearch search_;
  std::vector<Piece> pieces_;
};
}  // namespace

ConvexHulls convexHulls(const TriangleMesh& part)
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : part.triangles)
    for (const std::uint32_t index : triangle)
    {
      if (index >= part.vertices.size())
        throw std::invalid_argument("a mesh's triangle names a vertex that it does not have");
      box.extend(part.vertices[index].cast<double>());
    }
  if (!(enclosedVolume(part) > 0))
    throw std::invalid_argument("the part has no volume: give a closed mesh wound outwards");
  Decomposition decomposition(part, box.sizes().maxCoeff());
  for (int round = 0; round < 2; ++round)  // joining makes room for better cuts
  {
    decomposition.cutAll();
    decomposition.joinAll();
  }
  return decomposition.hulls();
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/boundary.hpp"

#include "ppf_bin_picking/core/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace ppf_bin_picking
{
namespace
{
constexpr int kGapReach_px = 12;        // missing pixels between the surface and what lies behind
constexpr int kDirectionRadius_px = 4;  // window that gives the boundary's direction
constexpr float kInside_px = 2.5F;  // from the boundary to the pixel that gives the surface's plane
constexpr float kMinFacing = 0.3F;
constexpr float kSameDirection = 0.8660254F;  // cosine of 30 degrees

bool inImage(const PinholeCamera& camera, int u, int v)
{
  return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
}

/// True if the image falls back beyond a pixel in a direction.
bool fallsBack(const RangeImage& image, int u, int v, int du, int dv, float jump_m)
{
  const float z0 = image.depth[image.index(u, v)];
  for (int k = 1; k <= kGapReach_px; ++k)
  {
    const int column = u + k * du, row = v + k * dv;
    if (!inImage(image.camera, column, row)) return false;
    const float z = image.depth[image.index(column, row)];
    if (z > 0) return z - z0 > jump_m;
  }
  return false;
}

/// From the surface to what is not of it around a pixel, unit length; zero if they balance.
Eigen::Vector2f awayFromSurface(const RangeImage& image, int u, int v, float jump_m)
{
  const float z0 = image.depth[image.index(u, v)];
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (int dv = -kDirectionRadius_px; dv <= kDirectionRadius_px; ++dv)
    for (int du = -kDirectionRadius_px; du <= kDirectionRadius_px; ++du)
    {
      if (du * du + dv * dv > kDirectionRadius_px * kDirectionRadius_px) continue;
      if (!inImage(image.camera, u + du, v + dv)) continue;
      const float z = image.depth[image.index(u + du, v + dv)];
      if (z == 0 || z - z0 > jump_m)
        sum += Eigen::Vector2f(static_cast<float>(du), static_cast<float>(dv));
    }
  const float length = sum.norm();
  return length > 1 ? Eigen::Vector2f(sum / length) : Eigen::Vector2f::Zero();
}

/// The frame at a pixel of the boundary, in the plane of the surface a little inside of it.
bool frameAt(const RangeImage& image, int u, int v, const Eigen::Vector2f& away, float jump_m,
             BoundaryPoint& boundary)
{
  const int u_inside = u - static_cast<int>(std::lround(kInside_px * away.x()));
  const int v_inside = v - static_cast<int>(std::lround(kInside_px * away.y()));
  if (!inImage(image.camera, u_inside, v_inside)) return false;
  const std::size_t inside = image.index(u_inside, v_inside);
  const Eigen::Vector3f& normal = image.normals[inside];
  if (image.depth[inside] == 0 || normal.isZero()) return false;
  if (std::abs(image.depth[inside] - image.depth[image.index(u, v)]) > jump_m) return false;
  const Eigen::Vector3f on_plane = image.point(u_inside, v_inside);
  const Eigen::Vector2f at(static_cast<float>(u), static_cast<float>(v));
  const auto point_at = [&](const Eigen::Vector2f& pixel) -> Eigen::Vector3f
  {
    const Eigen::Vector3f ray = image.camera.ray(pixel.x(), pixel.y());
    return ray * (normal.dot(on_plane) / normal.dot(ray));
  };
  const Eigen::Vector3f ray = image.camera.ray(at.x(), at.y());
  if (-normal.dot(ray) < kMinFacing * ray.norm()) return false;
  boundary.point = point_at(at + 0.5F * away);
  const Eigen::Vector3f along =
      (point_at(at + Eigen::Vector2f(-away.y(), away.x())) - point_at(at)).normalized();
  boundary.normal = normal;
  boundary.outward = along.cross(normal);
  if (boundary.outward.dot(point_at(at + away) - point_at(at)) < 0)
    boundary.outward = -boundary.outward;
  return boundary.point.allFinite() && boundary.outward.allFinite();
}

/// Boundary points of one cell whose frames point alike.
class AlikePoints
{
public:
  explicit AlikePoints(const BoundaryPoint& first) : first_(first), sum_(first) {}

  bool takes(const BoundaryPoint& boundary) const
  {
    return first_.normal.dot(boundary.normal) > kSameDirection &&
           first_.outward.dot(boundary.outward) > kSameDirection;
  }

  void add(const BoundaryPoint& boundary)
  {
    sum_.point += boundary.point;
    sum_.normal += boundary.normal;
    sum_.outward += boundary.outward;
    count_ += 1;
  }

  BoundaryPoint mean() const
  {
    BoundaryPoint mean;
    mean.point = sum_.point / count_;
    mean.normal = sum_.normal.normalized();
    mean.outward = (sum_.outward - mean.normal * mean.normal.dot(sum_.outward)).normalized();
    return mean;
  }

private:
  BoundaryPoint first_;
  BoundaryPoint sum_;
  float count_ = 1;
};
}  // namespace

std::vector<BoundaryPoint> boundaryOf(const RangeImage& image, float jump_m, int threads)
{
  constexpr std::array<std::array<int, 2>, 4> kSides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<std::vector<BoundaryPoint>> rows(static_cast<std::size_t>(image.camera.height));
  const auto search_row = [&](std::size_t row)
  {
    const int v = static_cast<int>(row);
    for (int u = 0; u < image.camera.width; ++u)
    {
      const std::size_t i = image.index(u, v);
      if (image.depth[i] == 0 || !image.in_roi[i]) continue;
      bool ends = false;
      for (const auto& [du, dv] : kSides)
        ends = ends || fallsBack(image, u, v, du, dv, jump_m);
      if (!ends) continue;
      const Eigen::Vector2f away = awayFromSurface(image, u, v, jump_m);
      BoundaryPoint boundary;
      if (!away.isZero() && frameAt(image, u, v, away, jump_m, boundary))
        rows[row].push_back(boundary);
    }
  };
  parallelFor(threads, rows.size(), search_row);
  std::vector<BoundaryPoint> points;
  for (const std::vector<BoundaryPoint>& row : rows)
    points.insert(points.end(), row.begin(), row.end());
  return points;
}

std::vector<BoundaryPoint> thinOutBoundary(const std::vector<BoundaryPoint>& points, float cell_m)
{
  std::vector<AlikePoints> groups;
  std::map<std::array<std::int32_t, 3>, std::vector<std::size_t>> cells;
  for (const BoundaryPoint& boundary : points)
  {
    const Eigen::Array3f cell = (boundary.point / cell_m).array().floor();
    std::vector<std::size_t>& here =
        cells[{static_cast<std::int32_t>(cell.x()), static_cast<std::int32_t>(cell.y()),
               static_cast<std::int32_t>(cell.z())}];
    const auto known =
        std::find_if(here.begin(), here.end(),
                     [&](const std::size_t group) { return groups[group].takes(boundary); });
    if (known != here.end())
    {
      groups[*known].add(boundary);
      continue;
    }
    here.push_back(groups.size());
    groups.emplace_back(boundary);
  }
  std::vector<BoundaryPoint> thin;
  for (const AlikePoints& group : groups)
    thin.push_back(group.mean());
  return thin;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/viewpoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace ppf_bin_picking
{
namespace
{
constexpr int kViews = 200;
constexpr int kViewSize_px = 256;
constexpr float kViewDistanceRel = 8.0F;      // camera distance, relative to the diameter
constexpr float kDepthToleranceRel = 0.004F;  // a sample this near to the depth image is seen
constexpr float kMinViewCosine = 0.15F;       // flatter views decide nothing
constexpr float kSameDirection = 0.8660254F;  // cosine of 30 degrees
constexpr std::size_t kMaxSamples = 400000;
constexpr double kMaxCountedCells = 4e6;  // more are sorted instead of counted

struct SurfaceSample
{
  Eigen::Vector3f point;
  std::uint32_t triangle;
  int seen_front = 0;
  int seen_back = 0;
};

Eigen::Vector3f scaledNormal(const TriangleMesh& mesh, std::size_t triangle)
{
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

/// Counts for each sample from how many views its front and its back are seen.
void countViews(const TriangleMesh& mesh, std::vector<SurfaceSample>& samples)
{
  const Eigen::Vector3f center = boundingSphereCenter(mesh);
  const float diameter = meshDiameter(mesh);
  const float distance = kViewDistanceRel * diameter;
  const float focal = 0.85F * kViewSize_px * kViewDistanceRel;
  const PinholeCamera camera{kViewSize_px, kViewSize_px,     focal,
                             focal,        kViewSize_px / 2, kViewSize_px / 2};
  RenderableMesh part(mesh);
  part.closed = false;  // the winding may be inside out
  RenderedPart view;
  for (const Eigen::Isometry3f& T_camera_model : viewpointsAround(center, distance, kViews))
  {
    renderPart(part, T_camera_model, camera, view);
    for (SurfaceSample& sample : samples)
    {
      const Eigen::Vector3f p = T_camera_model * sample.point;
      const float cosine = -view.normals[sample.triangle].dot(p.normalized());
      if (std::abs(cosine) < kMinViewCosine) continue;
      const Eigen::Vector2f pixel = camera.project(p);
      const int column = static_cast<int>(std::lround(pixel.x())) - view.left;
      const int row = static_cast<int>(std::lround(pixel.y())) - view.top;
      if (column < 0 || row < 0 || column >= view.width || row >= view.height) continue;
      const float slant = std::sqrt(1 - cosine * cosine) / std::abs(cosine);
      const float tolerance = diameter * kDepthToleranceRel * (1 + slant);
      const float seen = view.depthAt(column, row);
      if (seen == 0 || p.z() > seen + tolerance) continue;
      const std::uint32_t shown =
          view.triangle[static_cast<std::size_t>(row) * view.width + column];
      const float same = view.normals[shown].dot(view.normals[sample.triangle]);
      if (std::abs(same) < kSameDirection) continue;  // a surface beside it, at an edge
      ++(cosine > 0 ? sample.seen_front : sample.seen_back);
    }
  }
}

/// Turns triangles round whose samples are seen mostly from behind.
void orientTriangles(TriangleMesh& mesh, std::vector<SurfaceSample>& samples)
{
  std::vector<int> balance(mesh.triangles.size(), 0);
  for (const SurfaceSample& sample : samples)
    balance[sample.triangle] += sample.seen_front - sample.seen_back;
  for (std::size_t i = 0; i < balance.size(); ++i)
    if (balance[i] < 0) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  for (SurfaceSample& sample : samples)
    if (balance[sample.triangle] < 0) std::swap(sample.seen_front, sample.seen_back);
}
using Cell = std::array<std::int32_t, 3>;

/// The box of some cells.
struct CellRange
{
  explicit CellRange(const std::vector<Cell>& cells)
  {
    for (const Cell& cell : cells)
      for (std::size_t k = 0; k < 3; ++k)
        first[k] = std::min(first[k], cell[k]), last[k] = std::max(last[k], cell[k]);
  }
  double size(std::size_t k) const { return 1.0 + last[k] - first[k]; }
  double count() const { return size(0) * size(1) * size(2); }
  /// In ascending order of the cells.
  std::size_t number(const Cell& cell) const
  {
    std::size_t number = 0;
    for (std::size_t k = 0; k < 3; ++k)
      number =
          number * static_cast<std::size_t>(size(k)) + static_cast<std::size_t>(cell[k] - first[k]);
    return number;
  }

  Cell first = {INT32_MAX, INT32_MAX, INT32_MAX};
  Cell last = {INT32_MIN, INT32_MIN, INT32_MIN};
};

/// Indices of the cells in ascending order, of equal ones as they come.
std::vector<std::uint32_t> orderByCell(const std::vector<Cell>& cells)
{
  std::vector<std::uint32_t> order(cells.size());
  const CellRange range(cells);
  if (cells.empty() || range.count() > kMaxCountedCells)
  {
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return cells[a] < cells[b]; });
    return order;
  }
  std::vector<std::uint32_t> next(static_cast<std::size_t>(range.count()) + 1, 0);
  for (const Cell& cell : cells)
    ++next[range.number(cell) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t i = 0; i < cells.size(); ++i)
    order[next[range.number(cells[i])]++] = static_cast<std::uint32_t>(i);
  return order;
}

/// The vertices that lie farthest in so many directions.
std::vector<Eigen::Vector3f> extremeVertices(const TriangleMesh& mesh, int directions)
{
  const auto count = static_cast<Eigen::Index>(mesh.vertices.size());
  const Eigen::ArrayX3f points =
      Eigen::Map<const Eigen::Matrix3Xf>(mesh.vertices.front().data(), 3, count).transpose();
  Eigen::ArrayXf height(count);
  std::vector<Eigen::Vector3f> extremes;
  for (int i = 0; i < directions; ++i)
  {
    const Eigen::Vector3f direction = evenDirection(i, directions);
    // with the brackets, rounded as vertex.dot(direction) is
    height = points.col(0) * direction.x() +
             (points.col(1) * direction.y() + points.col(2) * direction.z());
    Eigen::Index farthest = 0;
    height.maxCoeff(&farthest);
    extremes.push_back(mesh.vertices[static_cast<std::size_t>(farthest)]);
  }
  return extremes;
}
}  // namespace

float meshDiameter(const TriangleMesh& mesh)
{
  constexpr int kDirections = 2000;
  std::vector<Eigen::Vector3f> extremes;
  if (mesh.vertices.size() <= kDirections)
    extremes = mesh.vertices;
  else
    extremes = extremeVertices(mesh, kDirections);
  float largest = 0;
  for (const Eigen::Vector3f& a : extremes)
    for (const Eigen::Vector3f& b : extremes)
      largest = std::max(largest, (a - b).squaredNorm());
  return std::sqrt(largest);
}

Eigen::Vector3f boundingSphereCenter(const TriangleMesh& mesh)
{
  // Badoiu and Clarkson 2003: a step of 1 / (i + 1) towards the farthest point, again and again.
  if (mesh.vertices.empty()) return Eigen::Vector3f::Zero();
  Eigen::Vector3d center = mesh.vertices.front().cast<double>();
  for (int i = 1; i <= 1000; ++i)
  {
    const Eigen::Vector3f here = center.cast<float>();
    const auto farther = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b)
    { return (a - here).squaredNorm() < (b - here).squaredNorm(); };
    const Eigen::Vector3f& farthest =
        *std::max_element(mesh.vertices.begin(), mesh.vertices.end(), farther);
    center += (farthest.cast<double>() - center) / (i + 1);
  }
  return center.cast<float>();
}

std::vector<MeshSample> sampleTriangles(const TriangleMesh& mesh, float spacing_m)
{
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    area += 0.5 * scaledNormal(mesh, i).norm();
  const double per_sample =
      std::max(static_cast<double>(spacing_m) * spacing_m, area / static_cast<double>(kMaxSamples));
  std::vector<MeshSample> samples;
  double due = 0.5;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& [a, b, c] = mesh.triangles[i];
    due += 0.5 * scaledNormal(mesh, i).norm() / per_sample;
    for (int k = 1; due >= 1.0; due -= 1.0, ++k)
    {
      double s = std::fmod(0.5 + 0.7548776662466927 * k, 1.0);  // R2 sequence
      double t = std::fmod(0.5 + 0.5698402909980532 * k, 1.0);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Eigen::Vector3f point = mesh.vertices[a] +
                                    static_cast<float>(s) * (mesh.vertices[b] - mesh.vertices[a]) +
                                    static_cast<float>(t) * (mesh.vertices[c] - mesh.vertices[a]);
      samples.push_back({point, static_cast<std::uint32_t>(i)});
    }
  }
  return samples;
}

OrientedPoints sampleVisibleSurface(TriangleMesh& mesh, float spacing_m)
{
  std::vector<SurfaceSample> samples;
  for (const MeshSample& sample : sampleTriangles(mesh, spacing_m))
    samples.push_back({sample.point, sample.triangle});
  countViews(mesh, samples);
  orientTriangles(mesh, samples);
  const bool closed =
      RenderableMesh(mesh).closed;  // then no back is seen, whatever the tolerance lets through
  OrientedPoints cloud;
  for (const SurfaceSample& sample : samples)
  {
    const Eigen::Vector3f normal = scaledNormal(mesh, sample.triangle).normalized();
    if (sample.seen_front > 0) cloud.add(sample.point, normal);
    if (!closed && 4 * sample.seen_back > sample.seen_front) cloud.add(sample.point, -normal);
  }
  return cloud;
}

OrientedPoints thinOut(const OrientedPoints& cloud, float cell_m)
{
  std::vector<Cell> cells(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (int k = 0; k < 3; ++k)
      cells[i][k] = static_cast<std::int32_t>(std::floor(cloud.points[i][k] / cell_m));
  const std::vector<std::uint32_t> order = orderByCell(cells);
  OrientedPoints thinned;
  struct Direction
  {
    Eigen::Vector3f first, points, normals;
    float count;
  };
  std::vector<Direction> directions;
  for (std::size_t begin = 0; begin < order.size();)
  {
    std::size_t end = begin;
    directions.clear();
    for (; end < order.size() && cells[order[end]] == cells[order[begin]]; ++end)
    {
      const Eigen::Vector3f& point = cloud.points[order[end]];
      const Eigen::Vector3f& normal = cloud.normals[order[end]];
      const auto same = [&](const Direction& d) { return d.first.dot(normal) > kSameDirection; };
      const auto known = std::find_if(directions.begin(), directions.end(), same);
      if (known == directions.end())
        directions.push_back({normal, point, normal, 1});
      else
        known->points += point, known->normals += normal, known->count += 1;
    }
    for (const Direction& d : directions)
      thinned.add(d.points / d.count, d.normals.normalized());
    begin = end;
  }
  return thinned;
}
}  // namespace ppf_bin_picking

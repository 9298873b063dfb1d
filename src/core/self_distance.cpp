#include "ppf_bin_picking/core/self_distance.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr float kMovedSpacingRel = 0.0125F;  // of the samples that are moved
constexpr float kDenseSpacingRel = 0.005F;   // of those that lead to the triangles
constexpr std::size_t kNeighbors = 6;
constexpr std::size_t kFitSamples = 1500;
constexpr int kFitSteps = 8;
constexpr double kDampingShare = 1e-4;  // of the mean curvature: turns of a round stay put

Eigen::Vector3f onEdge(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                       const Eigen::Vector3f& point)
{
  const Eigen::Vector3f edge = b - a;
  const float length2 = edge.squaredNorm();
  const float t = length2 > 0 ? std::clamp(edge.dot(point - a) / length2, 0.0F, 1.0F) : 0.0F;
  return a + t * edge;
}

/// The point of a triangle nearest to a point.
Eigen::Vector3f onTriangle(const TriangleMesh& mesh, std::uint32_t triangle,
                           const Eigen::Vector3f& point)
{
  const auto& [i, j, k] = mesh.triangles[triangle];
  const Eigen::Vector3f &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const float area2 = normal.squaredNorm();
  if (area2 > 0)
  {
    Eigen::Vector3f foot = point - normal.dot(point - a) / area2 * normal;
    if ((b - a).cross(foot - a).dot(normal) >= 0 && (c - b).cross(foot - b).dot(normal) >= 0 &&
        (a - c).cross(foot - c).dot(normal) >= 0)
      return foot;
  }
  Eigen::Vector3f best = onEdge(a, b, point);
  for (const Eigen::Vector3f& other : {onEdge(b, c, point), onEdge(c, a, point)})
    if ((other - point).squaredNorm() < (best - point).squaredNorm()) best = other;
  return best;
}

/// The points in an order of which every beginning is spread over the surface.
OrientedPoints spread(const OrientedPoints& points)
{
  OrientedPoints spread;
  std::size_t stride = std::max<std::size_t>(1, points.size() * 618 / 1000);
  while (std::gcd(stride, points.size()) != 1)
    ++stride;
  for (std::size_t i = 0, at = 0; i < points.size(); ++i, at = (at + stride) % points.size())
    spread.add(points.points[at], points.normals[at]);
  return spread;
}
}  // namespace

SelfDistance::SelfDistance(const TriangleMesh& mesh) : mesh_(mesh), diameter_m_(meshDiameter(mesh))
{
  if (!(diameter_m_ > 0))
    throw std::invalid_argument(
        "the mesh has no surface: give one with at least a triangle of some area");
  const auto diameter_m = static_cast<float>(diameter_m_);
  surface_ = spread(sampleVisibleSurface(mesh_, kMovedSpacingRel * diameter_m));
  for (const MeshSample& sample : sampleTriangles(mesh_, kDenseSpacingRel * diameter_m))
  {
    dense_points_.push_back(sample.point);
    dense_triangles_.push_back(sample.triangle);
  }
  if (surface_.points.empty() || dense_points_.empty())
    throw std::invalid_argument(
        "the mesh has no surface: give one with at least a triangle of some area");
  for (const Eigen::Vector3f& point : surface_.points)
    center_ += point.cast<double>();
  center_ /= static_cast<double>(surface_.size());
  search_ = std::make_unique<NeighborSearch>(dense_points_);
}

SelfDistance::Foot SelfDistance::footOf(const Eigen::Vector3f& point) const
{
  thread_local std::vector<std::pair<std::uint32_t, float>> near;
  search_->nearest(point, kNeighbors, near);
  Foot best{point, 0, std::numeric_limits<float>::infinity()};
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    const std::uint32_t triangle = dense_triangles_[near[i].first];
    if (i > 0 && triangle == last) continue;
    last = triangle;
    const Eigen::Vector3f foot = onTriangle(mesh_, triangle, point);
    const float distance_m = (foot - point).norm();
    if (distance_m < best.distance_m) best = {foot, triangle, distance_m};
  }
  return best;
}

double SelfDistance::deviation(const Eigen::Isometry3d& T_model_model, double enough_m,
                               std::size_t samples) const
{
  const Eigen::Isometry3f motion = T_model_model.cast<float>();
  double largest = 0;
  for (std::size_t i = 0; i < std::min(samples, surface_.size()) && largest <= enough_m; ++i)
    largest = std::max<double>(largest, footOf(motion * surface_.points[i]).distance_m);
  return largest;
}

Eigen::Isometry3d SelfDistance::refined(Eigen::Isometry3d T_model_model, double gate_m) const
{
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  for (int step = 0; step < kFitSteps; ++step)
  {
    Matrix6 matrix = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < std::min(kFitSamples, surface_.size()); ++i)
    {
      const Eigen::Vector3d p = T_model_model * surface_.points[i].cast<double>();
      const Foot foot = footOf(p.cast<float>());
      if (foot.distance_m > gate_m) continue;
      const auto& [a, b, c] = mesh_.triangles[foot.triangle];
      const Eigen::Vector3d normal = (mesh_.vertices[b] - mesh_.vertices[a])
                                         .cross(mesh_.vertices[c] - mesh_.vertices[a])
                                         .cast<double>()
                                         .normalized();
      Vector6 j;
      j << ((p - center_) / diameter_m_).cross(normal), normal;
      matrix += j * j.transpose();
      right += normal.dot(foot.point.cast<double>() - p) * j;
    }
    matrix += kDampingShare * matrix.trace() / 6 * Matrix6::Identity();
    const Vector6 move = matrix.ldlt().solve(right);
    if (!move.allFinite()) break;
    const Eigen::Vector3d turn = move.head<3>() / diameter_m_;
    if (turn.norm() > 0)
      T_model_model = Eigen::Translation3d(center_) *
                      Eigen::AngleAxisd(turn.norm(), turn.normalized()) *
                      Eigen::Translation3d(-center_) * T_model_model;
    T_model_model.pretranslate(move.tail<3>());
  }
  T_model_model.linear() =
      Eigen::Quaterniond(T_model_model.linear()).normalized().toRotationMatrix();
  return T_model_model;
}
}  // namespace ppf_bin_picking

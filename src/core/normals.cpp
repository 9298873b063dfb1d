#include "ppf_bin_picking/core/normals.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/parallel.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr int kMinFitPixels = 6;
constexpr int kFitPasses = 2;
constexpr float kSecondGateShare = 0.35F;  // of the first gate, about the first plane

/// Normal at a pixel: 1/z = a u + b v + c over the window, as the plane's normal is (a fx, b fy, a
/// cx + b cy + c). Later passes keep only the neighbours near the plane of the pass before. Zero if
/// there are too few.
Eigen::Vector3f fitNormal(const RangeImage& image, int u0, int v0, int radius_px, float gate_m)
{
  const PinholeCamera& camera = image.camera;
  const float z0 = image.depth[image.index(u0, v0)];
  Eigen::Vector3f plane(0, 0, 1 / z0);  // relative to (u0, v0)
  for (int pass = 0; pass < kFitPasses; ++pass)
  {
    Eigen::Matrix3f normal_matrix = Eigen::Matrix3f::Zero();
    Eigen::Vector3f right_side = Eigen::Vector3f::Zero();
    int used = 0;
    for (int v = std::max(0, v0 - radius_px); v <= std::min(camera.height - 1, v0 + radius_px); ++v)
      for (int u = std::max(0, u0 - radius_px); u <= std::min(camera.width - 1, u0 + radius_px);
           ++u)
      {
        const float z = image.depth[image.index(u, v)];
        if (z == 0) continue;
        const Eigen::Vector3f row(static_cast<float>(u - u0), static_cast<float>(v - v0), 1);
        const float expected = 1 / plane.dot(row);
        if (!(std::abs(z - expected) < (pass == 0 ? gate_m : gate_m * kSecondGateShare))) continue;
        normal_matrix += row * row.transpose();
        right_side += row / z;
        ++used;
      }
    if (used < kMinFitPixels) return Eigen::Vector3f::Zero();
    const float determinant = normal_matrix.determinant();
    if (!(determinant > 1e-3F * static_cast<float>(used))) return Eigen::Vector3f::Zero();
    plane = normal_matrix.inverse() * right_side;
  }
  const float offset =
      plane.z() - plane.x() * static_cast<float>(u0) - plane.y() * static_cast<float>(v0);
  const Eigen::Vector3f normal(plane.x() * camera.fx, plane.y() * camera.fy,
                               plane.x() * camera.cx + plane.y() * camera.cy + offset);
  return -normal.normalized();
}
}  // namespace

void estimateImageNormals(RangeImage& image, int radius_px, float depth_gate_m, int threads)
{
  image.normals.assign(image.depth.size(), Eigen::Vector3f::Zero());
  const auto fit_row = [&](std::size_t row)
  {
    const int v = static_cast<int>(row);
    for (int u = 0; u < image.camera.width; ++u)
      if (image.depth[image.index(u, v)] > 0)
        image.normals[image.index(u, v)] = fitNormal(image, u, v, radius_px, depth_gate_m);
  };
  parallelFor(threads, static_cast<std::size_t>(image.camera.height), fit_row);
}

std::vector<Eigen::Vector3f> estimatePointNormals(const std::vector<Eigen::Vector3f>& points,
                                                  int neighbors, float max_radius_m, int threads)
{
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::Zero());
  const NeighborSearch search(points);
  const auto fit = [&](std::size_t i)
  {
    thread_local std::vector<std::pair<std::uint32_t, float>> near;
    search.nearest(points[i], static_cast<std::size_t>(neighbors), near);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Matrix3f moments = Eigen::Matrix3f::Zero();
    int used = 0;
    for (const auto& [index, squared_distance] : near)
    {
      if (squared_distance > max_radius_m * max_radius_m) break;
      const Eigen::Vector3f offset = points[index] - points[i];
      mean += offset;
      moments += offset * offset.transpose();
      ++used;
    }
    if (used < 4) return;
    const auto count = static_cast<float>(used);
    const Eigen::Matrix3f covariance =
        moments / count - (mean / count) * (mean / count).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(covariance);
    const Eigen::Vector3f normal = solver.eigenvectors().col(0);
    if (solver.eigenvalues()(1) > 0)
      normals[i] = normal.dot(points[i]) > 0 ? Eigen::Vector3f(-normal) : normal;
  };
  parallelFor(threads, points.size(), fit);
  return normals;
}
}  // namespace ppf_bin_picking

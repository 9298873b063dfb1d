#include "ppf_bin_picking/core/normals.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/normal_kernel.hpp"
#include "ppf_bin_picking/core/parallel.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kMinFitPixels = 6;
constexpr float kSecondGateShare = 0.35F;  // of the first gate, about the first plane

/// The normal of the plane 1/z = a (u - u0) + b (v - v0) + c, which is (a fx, b fy, a cx + b cy + c
/// - a u0 - b v0) but for its length; towards the camera.
Eigen::Vector3f normalOf(const PinholeCamera& camera, int u0, int v0, float a, float b, float c)
{
  const float offset = c - a * static_cast<float>(u0) - b * static_cast<float>(v0);
  const Eigen::Vector3f normal(a * camera.fx, b * camera.fy,
                               a * camera.cx + b * camera.cy + offset);
  return -normal.normalized();
}
}  // namespace

void estimateImageNormals(RangeImage& image, int radius_px, float depth_gate_m, int threads)
{
  const PinholeCamera& camera = image.camera;
  image.normals.assign(image.depth.size(), Eigen::Vector3f::Zero());
  const PaddedDepth padded(image.depth.data(), camera.width, camera.height, radius_px);
  const PlaneFit fit{radius_px, depth_gate_m, depth_gate_m * kSecondGateShare, kMinFitPixels};
  const auto fit_row = [&](std::size_t row)
  {
    const int v = static_cast<int>(row);
    PlaneLanes planes;
    for (int first = 0; first < camera.width; first += kPlaneLanes)
    {
      fitPlanes(padded, fit, first, v, planes);
      for (int k = 0; k < std::min(kPlaneLanes, camera.width - first); ++k)
        if (planes.c[k] > 0)
          image.normals[image.index(first + k, v)] =
              normalOf(camera, first + k, v, planes.a[k], planes.b[k], planes.c[k]);
    }
  };
  parallelFor(threads, static_cast<std::size_t>(camera.height), fit_row);
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

#include "ppf_bin_picking/core/sample_balance.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kLookedThrough = 2.0F;  // weights of contradictions
constexpr float kWrongNormal = 1.0F;
constexpr float kMissing = 0.4F;

/// What one sample says, in the camera frame.
float balanceOf(const RangeImage& image, const Eigen::Vector3f& point,
                const Eigen::Vector3f& normal, float gate_m, float min_normal_cosine)
{
  int u, v;
  if (!image.camera.pixelOf(point, u, v)) return 0;
  const std::size_t pixel = image.index(u, v);
  if (image.depth[pixel] == 0) return -kMissing;
  const float behind_m = normal.dot(point - image.point(u, v));
  if (behind_m < -gate_m) return 0;  // hidden, perhaps by the part itself
  if (behind_m > gate_m) return -kLookedThrough;
  if (!image.normals[pixel].isZero() && image.normals[pixel].dot(normal) < min_normal_cosine)
    return -kWrongNormal;
  return image.in_roi[pixel] ? 1.0F : 0.0F;
}
}  // namespace

bool facesCamera(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
{
  constexpr float kMinFacing = 0.25F;  // surfaces flatter to the line of sight are left out
  return -normal.dot(point) > kMinFacing * point.norm();
}

float sampleBalance(const RangeImage& image, const PointArrays& samples,
                    const Eigen::Isometry3f& T_camera_samples, float gate_m,
                    const DetectorConfig& config)
{
  const float min_normal_cosine = std::cos(static_cast<float>(config.normal_gate_rad));
  float balance = 0, count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const Eigen::Vector3f point =
        T_camera_samples * Eigen::Vector3f(samples.x[i], samples.y[i], samples.z[i]);
    const Eigen::Vector3f normal =
        T_camera_samples.linear() * Eigen::Vector3f(samples.nx[i], samples.ny[i], samples.nz[i]);
    if (!facesCamera(point, normal)) continue;
    count += 1;
    balance += balanceOf(image, point, normal, gate_m, min_normal_cosine);
  }
  return balance / std::max(1.0F, count);
}
}  // namespace ppf_bin_picking

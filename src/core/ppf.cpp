#include "ppf_bin_picking/core/ppf.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kPi = 3.14159265358979F;

float angleOfCosine(float cosine)
{
  return std::acos(std::clamp(cosine, -1.0F, 1.0F));
}
}  // namespace

PairFeature pairFeature(const Eigen::Vector3f& p1, const Eigen::Vector3f& n1,
                        const Eigen::Vector3f& p2, const Eigen::Vector3f& n2)
{
  PairFeature feature;
  const Eigen::Vector3f d = p2 - p1;
  feature.distance_m = d.norm();
  feature.angle_n1_n2_rad = angleOfCosine(n1.dot(n2));
  if (feature.distance_m > 0)
  {
    feature.angle_n1_d_rad = angleOfCosine(n1.dot(d) / feature.distance_m);
    feature.angle_n2_d_rad = angleOfCosine(n2.dot(d) / feature.distance_m);
  }
  return feature;
}

FeatureQuantizer::FeatureQuantizer(const ModelParameters& parameters, float diameter_m)
    : diameter_m_(diameter_m),
      inverse_distance_step_(1.0F / (static_cast<float>(parameters.step_rel) * diameter_m)),
      inverse_angle_step_(static_cast<float>(parameters.n_angle) / (2 * kPi)),
      distance_bins_(static_cast<std::uint32_t>(std::ceil(1.0 / parameters.step_rel)) + 1),
      angle_bins_(static_cast<std::uint32_t>((parameters.n_angle + 1) / 2))
{
}

std::uint32_t FeatureQuantizer::angleBin(float angle_rad) const
{
  return std::min(static_cast<std::uint32_t>(angle_rad * inverse_angle_step_), angle_bins_ - 1);
}

std::uint32_t FeatureQuantizer::key(const PairFeature& feature) const
{
  const auto distance = static_cast<std::uint32_t>(feature.distance_m * inverse_distance_step_);
  std::uint32_t key = std::min(distance, distance_bins_ - 1);
  key = key * angle_bins_ + angleBin(feature.angle_n1_d_rad);
  key = key * angle_bins_ + angleBin(feature.angle_n2_d_rad);
  return key * angle_bins_ + angleBin(feature.angle_n1_n2_rad);
}

Eigen::Matrix3f rotationToX(const Eigen::Vector3f& normal)
{
  Eigen::Matrix3f rotation;
  rotation.row(0) = normal;
  rotation.row(1) = normal.unitOrthogonal();
  rotation.row(2) = normal.cross(Eigen::Vector3f(rotation.row(1)));
  return rotation;
}

std::uint16_t pairAlpha(const Eigen::Matrix3f& R_local_cloud, const Eigen::Vector3f& p1,
                        const Eigen::Vector3f& p2)
{
  const Eigen::Vector3f d = p2 - p1;
  const float y = R_local_cloud.row(1).dot(d);
  const float z = R_local_cloud.row(2).dot(d);
  const float turns = std::atan2(-z, y) / (2 * kPi);
  return static_cast<std::uint16_t>(static_cast<std::int32_t>(std::floor(turns * kAlphaTurn)));
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/ppf.hpp"

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kPi = 3.14159265F;

float dotOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  return dot3(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
}
}  // namespace

PairFeature pairFeature(const Eigen::Vector3f& p1, const Eigen::Vector3f& n1,
                        const Eigen::Vector3f& p2, const Eigen::Vector3f& n2)
{
  const Eigen::Vector3f d = p2 - p1;
  PairFeature feature;
  feature.distance_m = std::sqrt(dotOf(d, d));
  feature.angle_n1_n2_rad = arcCosine(dotOf(n1, n2));
  if (feature.distance_m > 0)
  {
    const float inverse = 1.0F / feature.distance_m;
    feature.angle_n1_d_rad = arcCosine(dotOf(n1, d) * inverse);
    feature.angle_n2_d_rad = arcCosine(dotOf(n2, d) * inverse);
  }
  return feature;
}

FeatureQuantizer::FeatureQuantizer(const ModelParameters& parameters, float diameter_m)
    : steps_{diameter_m, 1.0F / (static_cast<float>(parameters.step_rel) * diameter_m),
             static_cast<float>(parameters.n_angle) / (2 * kPi),
             static_cast<std::int32_t>(std::ceil(1.0 / parameters.step_rel)) + 1,
             (parameters.n_angle + 1) / 2}
{
}

std::uint32_t FeatureQuantizer::key(const PairFeature& feature) const
{
  return keyOf(steps_, feature.distance_m, feature.angle_n1_d_rad, feature.angle_n2_d_rad,
               feature.angle_n1_n2_rad);
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
  return alphaOf(dotOf(R_local_cloud.row(1), d), dotOf(R_local_cloud.row(2), d));
}

PairReference pairReference(const Eigen::Vector3f& p1, const Eigen::Vector3f& n1)
{
  const Eigen::Matrix3f R_local_cloud = rotationToX(n1);
  PairReference reference;
  for (int k = 0; k < 3; ++k)
  {
    reference.p[k] = p1[k];
    reference.n[k] = n1[k];
    reference.y_axis[k] = R_local_cloud(1, k);
    reference.z_axis[k] = R_local_cloud(2, k);
  }
  return reference;
}
}  // namespace ppf_bin_picking

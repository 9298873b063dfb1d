#include "ppf_bin_picking/core/viewpoints.hpp"

#include <cmath>

namespace ppf_bin_picking
{
Eigen::Vector3f evenDirection(int index, int count)
{
  const double z = 1.0 - (2.0 * index + 1.0) / count;
  const double turn = 2.0 * M_PI * index * 0.6180339887498949;
  const double r = std::sqrt(1.0 - z * z);
  return Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z).cast<float>();
}

std::vector<Eigen::Isometry3f> viewpointsAround(const Eigen::Vector3f& center, float distance_m,
                                                int count)
{
  std::vector<Eigen::Isometry3f> poses;
  for (int i = 0; i < count; ++i)
  {
    Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();
    T_camera_model.linear() =
        Eigen::Quaternionf::FromTwoVectors(evenDirection(i, count), -Eigen::Vector3f::UnitZ())
            .toRotationMatrix();
    T_camera_model.translation() =
        Eigen::Vector3f(0, 0, distance_m) - T_camera_model.linear() * center;
    poses.push_back(T_camera_model);
  }
  return poses;
}
}  // namespace ppf_bin_picking

/// @file The box in which parts are looked for.
#pragma once

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// A box, axis-aligned in its own frame.
struct RegionOfInterest
{
  Eigen::Isometry3d T_cloud_box = Eigen::Isometry3d::Identity();  ///< Box frame to cloud frame [m].
  Eigen::Vector3d min = Eigen::Vector3d::Zero();                  ///< Corner in the box frame [m].
  Eigen::Vector3d max = Eigen::Vector3d::Zero();  ///< Opposite corner; each above min [m].

  /// True if a point of the cloud's frame [m] lies inside or on the border.
  bool contains(const Eigen::Vector3f& point_cloud) const
  {
    const Eigen::Vector3d p = T_cloud_box.inverse() * point_cloud.cast<double>();
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }

  /// Length of the space diagonal [m].
  double diagonal() const { return (max - min).norm(); }
};
}  // namespace ppf_bin_picking

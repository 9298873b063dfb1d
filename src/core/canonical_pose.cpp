#include "ppf_bin_picking/core/canonical_pose.hpp"

#include <array>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr double kEqualTurn = 1e-9;  // of a quaternion's components

/// The reference orientation: 60 degrees about (1, 2, 3).
Eigen::Quaterniond reference()
{
  return Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 3, Eigen::Vector3d(1, 2, 3).normalized()));
}

/// The turn of a pose from an orientation, w not negative.
std::array<double, 4> turnFrom(const Eigen::Quaterniond& orientation, const Eigen::Isometry3d& pose)
{
  const Eigen::Quaterniond turn = orientation.conjugate() * Eigen::Quaterniond(pose.linear());
  const double sign = turn.w() < 0 ? -1 : 1;
  return {sign * turn.w(), sign * turn.x(), sign * turn.y(), sign * turn.z()};
}

/// Whether a turn is less than another, ties broken.
bool isLess(const std::array<double, 4>& a, const std::array<double, 4>& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kEqualTurn) return a[i] > b[i];
  return false;
}

/// The pose turned about an axis of revolution until the turn from an orientation is least: with
/// that turn as quaternion (w, v), the one after it has the real part w cos(a/2) - v . axis
/// sin(a/2).
Eigen::Isometry3d turnedBack(const Eigen::Isometry3d& pose, const SymmetryAxis& line)
{
  double real = 0, along = 0;
  // Where the axis points away from where the reference has it, all turns are equal: then the half
  // turn about x is the reference.
  for (const Eigen::Quaterniond& orientation : {reference(), Eigen::Quaterniond(0, 1, 0, 0)})
  {
    const Eigen::Quaterniond turn = orientation.conjugate() * Eigen::Quaterniond(pose.linear());
    real = turn.w();
    along = turn.vec().dot(line.axis);
    if (std::hypot(real, along) > kEqualTurn) break;
  }
  return pose * turnAbout(line, 2 * std::atan2(-along, real));
}
}  // namespace

Eigen::Isometry3d canonicalPose(const Eigen::Isometry3d& T_cloud_model,
                                const SymmetryGroup& symmetries)
{
  Eigen::Isometry3d best = T_cloud_model;
  if (symmetries.sphere())
  {
    const Eigen::Vector3d& center = symmetries.sphereCenter();
    best.linear() = reference().toRotationMatrix();
    best.translation() = T_cloud_model * center - best.linear() * center;
    return best;
  }
  bool first = true;
  for (const Eigen::Isometry3d& motion : symmetries.motions())
  {
    Eigen::Isometry3d pose = T_cloud_model * motion;
    if (symmetries.revolution()) pose = turnedBack(pose, *symmetries.revolution());
    if (first || isLess(turnFrom(reference(), pose), turnFrom(reference(), best))) best = pose;
    first = false;
  }
  return best;
}
}  // namespace ppf_bin_picking

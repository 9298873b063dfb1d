#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxMotions = 1000;
constexpr double kSameMotion = 1e-6;

SymmetryAxis normalized(SymmetryAxis line)
{
  const double length = line.axis.norm();
  if (!(length > 0) || !std::isfinite(length) || !line.point.allFinite())
    throw std::invalid_argument(
        "a symmetry's axis has no length or is not finite: give a direction such as [0, 0, 1]");
  line.axis /= length;
  return line;
}

/// All products of the generators.
std::vector<Eigen::Isometry3d> closure(const std::vector<Eigen::Isometry3d>& generators)
{
  std::vector<Eigen::Isometry3d> motions = {Eigen::Isometry3d::Identity()};
  for (std::size_t next = 0; next < motions.size(); ++next)
  {
    for (const Eigen::Isometry3d& generator : generators)
    {
      const Eigen::Isometry3d candidate = motions[next] * generator;
      const auto same = [&](const Eigen::Isometry3d& known)
      { return (known.matrix() - candidate.matrix()).cwiseAbs().maxCoeff() < kSameMotion; };
      if (std::any_of(motions.begin(), motions.end(), same)) continue;
      if (motions.size() == kMaxMotions)
        throw std::invalid_argument(
            "the discrete symmetries have no end: give angles that divide the full turn, and axes "
            "that the part has");
      motions.push_back(candidate);
    }
  }
  return motions;
}

/// Angle between a and b [rad] of the rotation a^-1 b.
double angleBetween(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b)
{
  const double dot = std::min(1.0, std::abs(static_cast<double>(a.dot(b))));
  return 2.0 * std::acos(dot);
}
}  // namespace

Eigen::Isometry3d turnAbout(const SymmetryAxis& line, double angle_rad)
{
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::AngleAxisd(angle_rad, line.axis).toRotationMatrix();
  motion.translation() = line.point - motion.linear() * line.point;
  return motion;
}

Eigen::Vector3d meetingPoint(const std::vector<SymmetryAxis>& lines)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const SymmetryAxis& line : lines)
  {
    const Eigen::Vector3d axis = line.axis.normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    sum += across;
    right += across * line.point;
  }
  return sum.ldlt().solve(right);
}

SymmetryGroup::SymmetryGroup() : SymmetryGroup({}, {}) {}

SymmetryGroup::SymmetryGroup(const std::vector<DiscreteSymmetry>& discrete,
                             const std::vector<SymmetryAxis>& revolution)
    : generators_(discrete), revolution_axes_(revolution)
{
  std::vector<Eigen::Isometry3d> generators;
  for (const DiscreteSymmetry& symmetry : discrete)
    generators.push_back(turnAbout(normalized(symmetry.line), symmetry.angle_rad));
  motions_ = closure(generators);
  for (const Eigen::Isometry3d& motion : motions_)
    rotations_.emplace_back(motion.linear().cast<float>());
  if (revolution.empty()) return;

  revolution_ = normalized(revolution.front());
  sphere_ = std::any_of(
      revolution.begin(), revolution.end(),
      [&](const SymmetryAxis& other)
      { return std::abs(normalized(other).axis.dot(revolution_->axis)) < 1 - kSameMotion; });
  if (sphere_) sphere_center_ = meetingPoint(revolution_axes_);
  for (const Eigen::Isometry3d& motion : motions_)
  {
    const Eigen::Vector3f image = (motion.linear() * revolution_->axis).cast<float>();
    const auto same = [&](const Eigen::Vector3f& known) { return (known - image).norm() < 1e-5F; };
    if (std::none_of(axis_images_.begin(), axis_images_.end(), same)) axis_images_.push_back(image);
  }
}

double SymmetryGroup::rotationDistance(const Eigen::Quaternionf& a,
                                       const Eigen::Quaternionf& b) const
{
  if (sphere_) return 0.0;
  double smallest = M_PI;
  if (revolution_)
  {
    const Eigen::Vector3f axis_a = a * revolution_->axis.cast<float>();
    for (const Eigen::Vector3f& image : axis_images_)
    {
      const double cosine = std::clamp(axis_a.dot(b * image), -1.0F, 1.0F);
      smallest = std::min(smallest, std::acos(cosine));
    }
    return smallest;
  }
  for (const Eigen::Quaternionf& rotation : rotations_)
    smallest = std::min(smallest, angleBetween(a, b * rotation));
  return smallest;
}
}  // namespace ppf_bin_picking

/// @file The motions that map a part onto itself.
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// A rotation about a line that leaves the part as it was. Mesh frame.
struct SymmetryAxis
{
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< Direction of the line, unit length.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< A point on the line [m].
};

/// Turns of a discrete symmetry until the part is back, at most.
constexpr int kMaxTurns = 120;

/// One generator of the discrete symmetries.
struct DiscreteSymmetry
{
  SymmetryAxis line;
  double angle_rad = 0.0;  ///< Turn about the line that maps the part onto itself.
};

/// The turn about a line, T_model_model [m].
/// @param line  Its axis has unit length.
Eigen::Isometry3d turnAbout(const SymmetryAxis& line, double angle_rad);

/// The point nearest to all of at least two lines that are not parallel: where a sphere's axes
/// meet [m].
Eigen::Vector3d meetingPoint(const std::vector<SymmetryAxis>& lines);

/// All symmetries of a part: the group that the discrete generators span, times at most one
/// revolution. (Two different revolution axes make a sphere: then only the positions of two poses
/// are compared.)
class SymmetryGroup
{
public:
  SymmetryGroup();

  /// @param discrete    Generators; their closure is computed.
  /// @param revolution  Axes of revolution; at most two are used, two meaning a sphere.
  /// @throw std::invalid_argument if an axis has no length or the closure exceeds 1000 motions,
  /// that is, an
  ///        angle is not a divisor of the full turn.
  SymmetryGroup(const std::vector<DiscreteSymmetry>& discrete,
                const std::vector<SymmetryAxis>& revolution);

  /// The discrete motions, identity first. T_model_model [m].
  const std::vector<Eigen::Isometry3d>& motions() const { return motions_; }
  const std::optional<SymmetryAxis>& revolution() const { return revolution_; }
  bool sphere() const { return sphere_; }

  /// Where a sphere's axes meet, mesh frame [m]; meaningless for other parts.
  const Eigen::Vector3d& sphereCenter() const { return sphere_center_; }

  /// As given to the constructor, for files and messages.
  const std::vector<DiscreteSymmetry>& generators() const { return generators_; }
  const std::vector<SymmetryAxis>& revolutionAxes() const { return revolution_axes_; }

  /// The smallest rotation [rad] between two orientations T_x_model, over all symmetries: of the
  /// axis for a revolution, 0 for a sphere. Positions are not looked at.
  double rotationDistance(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) const;

private:
  std::vector<DiscreteSymmetry> generators_;
  std::vector<SymmetryAxis> revolution_axes_;
  std::vector<Eigen::Isometry3d> motions_;
  std::vector<Eigen::Quaternionf> rotations_;  ///< Rotation parts of motions_.
  std::vector<Eigen::Vector3f>
      axis_images_;  ///< Images of the revolution axis under motions_, deduplicated.
  std::optional<SymmetryAxis> revolution_;
  bool sphere_ = false;
  Eigen::Vector3d sphere_center_ = Eigen::Vector3d::Zero();
};
}  // namespace ppf_bin_picking

/// @file How far a found pose of a part is from the true one.
///
/// MSSD and MSPD are those of Hodan et al., BOP Challenge 2020 on 6D Object Localization (ECCV
/// workshops 2020), section 2, pose-error functions: the largest distance of a vertex between the
/// two poses, minimised over the poses that look like the true one. Two things are fixed here that
/// the paper leaves open: a mesh of many vertices is represented by 1000 of them, and a revolution
/// by turns of 2 degrees.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace ppf_bin_picking
{
/// A pose that looks like the true one, and how far a found pose is from it.
struct NearestTruth
{
  double error_m = std::numeric_limits<double>::infinity();  ///< MSSD; infinite: not near enough.
  Eigen::Isometry3d T_camera_model =
      Eigen::Isometry3d::Identity();  ///< The true pose times the symmetry that brings it nearest.
};

/// Compares poses of one part. Poses are T_camera_model [m]; a matrix that is a rotation only to
/// a few digits is used as it is.
class PoseErrors
{
public:
  static constexpr std::size_t kMaxVertices = 1000;        ///< More are thinned out evenly.
  static constexpr double kTurn_rad = 2.0 * M_PI / 180.0;  ///< Step of a revolution.
  static constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

  /// @param vertices    Of the mesh [m], each once. Where there are more than kMaxVertices, evenly
  ///                    spaced ones of this order are compared.
  /// @param symmetries  Every product of the discrete motions and of the turns about the revolution
  ///                    axis counts. A sphere counts as turned like the found pose.
  /// @throw std::invalid_argument if there are no vertices, or one is not finite.
  PoseErrors(const std::vector<Eigen::Vector3d>& vertices, const SymmetryGroup& symmetries);

  /// The largest distance between two of all vertices [m].
  double diameter() const { return diameter_m_; }

  /// Maximum symmetry-aware surface distance, if it is below a limit [m].
  NearestTruth mssd(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth,
                    double below_m = kAnyDistance) const;

  /// Maximum symmetry-aware projection distance [px], if it is below a limit [px]; else infinity.
  /// A vertex that is not in front of the camera is infinitely far off.
  double mspd(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth,
              const PinholeCamera& camera, double below_px = kAnyDistance) const;

  /// Distance between the vertices' means at two poses [m].
  double translation(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

  /// Angle between two poses [rad], symmetries left aside: of the axis for a part of revolution.
  double rotation(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

private:
  /// The truth; for a sphere turned like the found pose.
  Eigen::Isometry3d turnedTruth(const Eigen::Isometry3d& found,
                                const Eigen::Isometry3d& truth) const;

  std::vector<Eigen::Vector3d> vertices_;  ///< The compared ones.
  Eigen::Vector3d mean_;                   ///< Of these.
  double diameter_m_ = 0;
  std::vector<Eigen::Isometry3d> motions_;        ///< All symmetries, T_model_model.
  std::optional<Eigen::Vector3d> axis_;           ///< Of a revolution; none for a sphere.
  std::optional<Eigen::Vector3d> sphere_center_;  ///< Only of a sphere.
};
}  // namespace ppf_bin_picking

/// @file The four-number feature of one oriented point pair, its quantisation and its local angle.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/pair_kernel.hpp"

#include <Eigen/Geometry>

#include <cstdint>

namespace ppf_bin_picking
{
/// F(p1, p2) = (|d|, angle(n1, d), angle(n2, d), angle(n1, n2)), d = p2 - p1. Drost et al. 2010,
/// equation 1.
struct PairFeature
{
  float distance_m = 0;
  float angle_n1_d_rad = 0;   ///< In [0, pi].
  float angle_n2_d_rad = 0;   ///< In [0, pi].
  float angle_n1_n2_rad = 0;  ///< In [0, pi].
};

/// The feature of a pair of points [m] with unit normals. Two points in one place have distance and
/// angles to d of zero.
PairFeature pairFeature(const Eigen::Vector3f& p1, const Eigen::Vector3f& n1,
                        const Eigen::Vector3f& p2, const Eigen::Vector3f& n2);

/// Rounds features down to steps and numbers the cells.
class FeatureQuantizer
{
public:
  /// @param diameter_m  Longest pair; longer ones have no key.
  FeatureQuantizer(const ModelParameters& parameters, float diameter_m);

  /// Keys run from 0 to keyCount() - 1.
  std::uint32_t keyCount() const
  {
    return static_cast<std::uint32_t>(steps_.distance_bins * steps_.angle_bins * steps_.angle_bins *
                                      steps_.angle_bins);
  }

  /// True if a pair of this length [m] has a key.
  bool covers(float distance_m) const { return distance_m <= steps_.diameter_m; }

  /// The cell of a feature. The distance must be covered.
  std::uint32_t key(const PairFeature& feature) const;

  /// The same for pairKeys.
  const KeySteps& steps() const { return steps_; }

private:
  KeySteps steps_;
};

/// A rotation that turns a unit normal onto the x axis; the same for equal normals.
Eigen::Matrix3f rotationToX(const Eigen::Vector3f& normal);

/// The turn about the x axis that brings p2 into the half plane y > 0, z = 0 of the frame of (p1,
/// n1), as a share of the full turn times 65536 (Drost et al. 2010, section 3.2).
/// @param R_local_cloud  rotationToX(n1).
std::uint16_t pairAlpha(const Eigen::Matrix3f& R_local_cloud, const Eigen::Vector3f& p1,
                        const Eigen::Vector3f& p2);

/// The first point of pairs, for pairKeys.
PairReference pairReference(const Eigen::Vector3f& p1, const Eigen::Vector3f& n1);
}  // namespace ppf_bin_picking

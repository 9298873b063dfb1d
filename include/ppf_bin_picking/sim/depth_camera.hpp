/// @file A simulated depth camera and the truth about what it sees.
#pragma once

#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"

#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// What the measurement lacks.
struct DepthNoise
{
  double std_m = 0.0002;       ///< Standard deviation of the depth (z). >= 0.
  double max_slant_rad = 1.4;  ///< Surfaces seen at a flatter angle give no measurement.
};

/// One shot.
struct DepthView
{
  PointCloud cloud_camera;           ///< Organised; NaN where nothing was measured.
  std::vector<std::int32_t> object;  ///< Mesh seen by each pixel, measured or not; -1: none.
  std::vector<float> brightness;     ///< Of each pixel, lit from the camera; to look at. [0, 1]
};

/// The truth about one part.
struct PartTruth
{
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();  ///< [m]
  double visible_share = 0;  ///< Pixels that show it, of those that would if it were alone. [0, 1]
};

/// Optical frame of a camera that looks from a position at a target. Image right is as close to
/// +x as can be.
/// @return T_world_camera. @throw std::invalid_argument if it would look along x.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

/// Takes a shot. The same seed gives the same bytes for any number of threads.
/// @param threads  0: one per core.
/// @throw std::invalid_argument if the camera's numbers are out of range.
DepthView takeShot(const RayCaster& world, const PinholeCamera& camera,
                   const Eigen::Isometry3d& T_world_camera, const DepthNoise& noise,
                   std::uint32_t seed, int threads = 0);

/// Poses and visible shares of the parts of a shot.
/// @param part          Mesh of each part.
/// @param T_world_part  Poses; part k is object first_object + k of the shot.
std::vector<PartTruth> partTruths(const DepthView& view, const PinholeCamera& camera,
                                  const Eigen::Isometry3d& T_world_camera, const TriangleMesh& part,
                                  const std::vector<Eigen::Isometry3d>& T_world_part,
                                  std::int32_t first_object);
}  // namespace ppf_bin_picking

/// @file A simulated depth camera and the truth about what it sees.
#pragma once

#include "ppf_bin_picking/core/point_cloud.hpp"

#include "ppf_bin_picking/sim/depth_sensor.hpp"
#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// One shot.
struct DepthView
{
  PointCloud cloud_camera;           ///< Organised; NaN where nothing was measured.
  std::vector<std::int32_t> object;  ///< Mesh before each pixel, measured or not; -1: none.
  std::vector<float> brightness;     ///< Of each pixel, lit from the camera; to look at. [0, 1]
};

/// The truth about one part.
struct PartTruth
{
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();  ///< [m]
  /// Pixels that the part is before, of those that it would be before if it were alone. In [0, 1].
  /// It is the truth about what hides the part: shadows and other faults of the sensor do not
  /// count.
  double visible_share = 0;
};

/// Optical frame of a camera that looks from a position at a target. Image right is as close to
/// +x as can be.
/// @return T_world_camera. @throw std::invalid_argument if it would look along x.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

/// Takes a shot. Each pixel's ray, and with it its x / z and y / z, is exact; faults change the
/// depth or lose it. The same seed gives the same bytes for any number of threads.
/// @param threads  0: one per core.
/// @throw std::invalid_argument if the sensor has problems(), all of them named.
DepthView takeShot(const RayCaster& world, const DepthSensor& sensor,
                   const Eigen::Isometry3d& T_world_camera, std::uint32_t seed, int threads = 0);

/// Poses and visible shares of the parts of a shot.
/// @param part          Mesh of each part.
/// @param T_world_part  Poses; part k is object first_object + k of the shot.
std::vector<PartTruth> partTruths(const DepthView& view, const PinholeCamera& camera,
                                  const Eigen::Isometry3d& T_world_camera, const TriangleMesh& part,
                                  const std::vector<Eigen::Isometry3d>& T_world_part,
                                  std::int32_t first_object);
}  // namespace ppf_bin_picking

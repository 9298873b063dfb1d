/// @file A bin of parts under a depth camera.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/bin.hpp"
#include "ppf_bin_picking/sim/depth_camera.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// What a simulated cell looks like. Positions are those of the cell's base frame [m], z up.
struct CellSettings
{
  Bin bin;
  Eigen::Vector3d bin_position_m = {0.5, 0, 0};             ///< Of the middle of the bin's floor.
  Eigen::Vector3d camera_position_m = {0.37, -0.12, 0.75};  ///< The projector is on the other side.
  Eigen::Vector3d camera_target_m = {0.5, 0, 0.02};         ///< In the middle of the image.
  DepthSensor sensor = sensorPreset("industrial");
  std::string cache_folder;  ///< Keeps the part's convex hulls; empty: they are computed anew.
};

/// What the camera saw, and the truth about it.
struct CellShot
{
  DepthView view;
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();  ///< [m]
  std::vector<PartTruth> parts;
};

/// Drops parts into the bin and takes a shot when they are at rest. The same arguments give the same
/// bytes.
/// @param part  A closed mesh, wound outwards.
/// @throw std::invalid_argument if the part does not fit into the bin, the bin overflows, or the
///        sensor has problems.
CellShot simulateCell(const CellSettings& settings, const TriangleMesh& part, int count,
                      std::uint32_t seed);
}  // namespace ppf_bin_picking

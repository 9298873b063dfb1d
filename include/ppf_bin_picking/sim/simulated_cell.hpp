/// @file A bin of parts under a depth camera, from which parts are picked.
#pragma once

#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/sim/bin.hpp"
#include "ppf_bin_picking/sim/convex_hulls.hpp"
#include "ppf_bin_picking/sim/depth_camera.hpp"
#include "ppf_bin_picking/sim/part_pile.hpp"
#include "ppf_bin_picking/sim/pick_judge.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <random>
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
  PickRule pick;
};

/// The part of a cell.
struct CellPart
{
  TriangleMesh mesh;         ///< Closed, wound outwards [m].
  ConvexHulls hulls;         ///< convexHulls() of the mesh.
  SymmetryGroup symmetries;  ///< Poses that it makes equal are picked alike.
};

/// What the camera saw, and the truth about it.
struct CellShot
{
  DepthView view;
  std::vector<PartTruth> parts;  ///< In the order of SimulatedCell::parts().
};

/// The bin, its parts, the camera over it and the gripper. The same seed and the same calls give
/// the same bytes.
class SimulatedCell
{
public:
  /// The bin is empty at first.
  /// @param seed  Decides how parts fall and, apart from that, the noise of each shot.
  /// @throw std::invalid_argument if the part has no surface or no hull, or the rule of picks is
  ///        out of range.
  SimulatedCell(const CellSettings& settings, CellPart part, std::uint32_t seed);

  /// Drops more parts onto those in the bin and lets all settle.
  /// @param count  >= 0.
  /// @throw std::invalid_argument if the part does not fit into the bin or the bin overflows.
  void refill(int count);

  /// Sends the gripper to a pose. Where the verdict is kTaken, the part is taken out straight up
  /// and the others settle; else nothing changes.
  /// @param T_base_model  The pose to pick [m].
  PickVerdict pick(const Eigen::Isometry3d& T_base_model);

  /// Takes a shot, with new noise each time.
  /// @throw std::invalid_argument if the sensor has problems().
  CellShot shot();

  /// Where the parts lie now: T_base_model [m]. A part taken out moves those after it up one index.
  std::vector<Eigen::Isometry3d> parts() const;

  /// The camera's optical frame [m].
  const Eigen::Isometry3d& T_base_camera() const { return T_base_camera_; }
  /// Middle of the bin's floor, z up [m].
  const Eigen::Isometry3d& T_base_bin() const { return T_base_bin_; }

private:
  CellSettings settings_;
  CellPart part_;
  TriangleMesh bin_mesh_;
  PartPile pile_;
  PickJudge judge_;
  Eigen::Isometry3d T_base_bin_;
  Eigen::Isometry3d T_base_camera_;
  std::mt19937 drop_seeds_;
  std::mt19937 shot_seeds_;  ///< Apart, so that more shots do not change how parts fall.
};
}  // namespace ppf_bin_picking

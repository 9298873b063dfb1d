/// @file The simulated cell's parameters. No ROS: the node and the recorder read the same YAML.
#pragma once

#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// config/simulated_cell.yaml explains each.
struct CellParams
{
  static constexpr int kMaxParts = 500;
  static constexpr int kMaxSeed = 1000000;

  std::string part;         ///< Part file.
  int count = 12;           ///< Parts dropped at the start. In [0, kMaxParts].
  int seed = 1;             ///< In [0, kMaxSeed].
  double rate_hz = 0;       ///< Shots a second; 0: only when asked for. In [0, 100].
  std::string hull_folder;  ///< Where convex hulls are kept; empty: hullFolder() decides.
  std::string base_frame = "base_link";
  std::string bin_frame = "bin";
  std::string camera_frame = "camera_optical_frame";
  CellSettings cell;
};

/// Reads all parameters. What is left out has the value of CellParams.
/// @param where  The file or the node's name; begins every message.
/// @throw InputError naming an unknown key with its nearest known name, a value of a wrong type or
///        out of range, or the missing part.
CellParams readCellParams(const YAML::Node& node, const std::string& where);

/// The part that a cell holds.
struct LoadedCellPart
{
  std::string model_id;
  CellPart part;
  std::vector<std::string> warnings;  ///< About the mesh.
};

/// Loads part and mesh, and the hulls from the folder of hulls, where they are computed once.
/// @throw InputError naming the file and the remedy. @throw std::runtime_error if the folder cannot
///        be written.
LoadedCellPart loadCellPart(const CellParams& params);
}  // namespace ppf_bin_picking

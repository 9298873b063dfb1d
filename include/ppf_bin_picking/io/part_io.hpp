/// @file The description of a part: mesh, unit, symmetries, picks.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/io/length_unit.hpp"
#include "ppf_bin_picking/io/package_path.hpp"

#include <Eigen/Geometry>

#include <map>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Where a gripper may take the part.
struct Pick
{
  std::string name;
  Eigen::Isometry3d T_model_pick = Eigen::Isometry3d::Identity();  ///< [m]; +z into the part.
};

/// What a part file says, in metres and radians.
struct PartDescription
{
  std::string model_id;   ///< Key `model_id`; else the file's stem; for a part.yaml its folder.
  std::string mesh_file;  ///< Path.
  LengthUnit unit = LengthUnit::kMetre;  ///< Of the mesh file.
  std::vector<DiscreteSymmetry> symmetries_discrete;
  std::vector<SymmetryAxis> symmetries_continuous;
  bool states_symmetries = false;  ///< Either key is there, be its list empty.
  std::vector<Pick> picks;         ///< Best first.
  std::string model_file;          ///< Path of the trained model; empty: to be trained.
  std::map<std::string, std::string> detector;  ///< Settings that differ for this part. Checked.
  std::string source;                           ///< The part file, for messages.

  /// A configuration with the settings that differ for this part.
  DetectorConfig adapted(const DetectorConfig& config) const;

  /// Those that the file states. Never throws for a description that loadPart() returned.
  SymmetryGroup symmetries() const { return {symmetries_discrete, symmetries_continuous}; }
};

/// Reads a part file. `mesh` (default model.stl) and `model` are relative to the file's folder, or
/// `package://name/path`.
/// @throw InputError naming the file, the key and the remedy; also if the symmetries are no group.
PartDescription loadPart(const std::string& path, const PackageFinder& finder = findPackage);

/// The symmetries to work with: those that the part file states, checked against the mesh, or, if
/// it states none, those found in it.
struct PartSymmetries
{
  SymmetryGroup group;
  std::string summary;  ///< Where they are from and what they are, points in the mesh's unit.
  std::string warning;  ///< What the mesh has beside those stated, and what follows; empty: none.
};

/// @param mesh  Of the part [m].
/// @throw InputError if the mesh has not a symmetry that the file states, or no surface.
PartSymmetries symmetriesOf(const PartDescription& part, const TriangleMesh& mesh);
}  // namespace ppf_bin_picking

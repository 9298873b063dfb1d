/// @file Simulated scenes as files of a data set with ground truth:
///
///     DATASET/<part>/part.yaml, model.<ext>  the part, its mesh beside it
///     DATASET/<part>/<scene>/depth.png       16 bit along z, depth_unit_m a level, 0: no
///     measurement DATASET/<part>/<scene>/camera.yaml     as detect_poses reads it
///     DATASET/<part>/<scene>/roi.yaml        inside of the bin, as detect_poses reads it
///     DATASET/<part>/<scene>/gt.json         objects: [{pose: 16 numbers, row by row,
///                                            T_camera_model [m]; visibility: 0..1}], bin: {pose:
///                                            T_camera_bin, size: [x, y, z]}
///     DATASET/<part>/<scene>/preview.jpg     for people: a colour a part, dark: no measurement
#pragma once

#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Makes a folder, with those above it.
/// @throw InputError if it cannot be made.
void makeFolder(const std::string& path);

/// @throw InputError if a folder holds another part than writePart() would write there: scenes of
/// it would be judged by the wrong mesh.
void requireSamePart(const std::string& folder, const PartDescription& part);

/// Copies part file and mesh into a folder, as part.yaml that names the mesh beside it. The
/// folder's own part file stays as it is.
/// @throw InputError if a file cannot be read or written.
void writePart(const std::string& folder, const PartDescription& part);

/// A pile of parts as one camera saw it. The bin's frame is the cell's base frame.
struct SceneShot
{
  CellSettings cell;
  Eigen::Isometry3d T_bin_camera = Eigen::Isometry3d::Identity();  ///< [m]
  DepthView view;  ///< Object 0 is the bin, the others are the parts.
  std::vector<PartTruth> parts;
};

/// Writes the files of one scene.
/// @throw InputError if the folder cannot be made or written.
void writeScene(const std::string& folder, const SceneShot& shot);
}  // namespace ppf_bin_picking

/// @file Reading of data sets with ground truth, and of what was found in them.
///
///     DATASET/<part>/part.yaml                part file, and the mesh that it names
///     DATASET/<part>/<scene>/gt.json          objects: [{pose: 16 numbers, visibility: 0..1}]
///     DATASET/<part>/<scene>/depth.png, camera.yaml
///     RESULTS/<part>/<scene>.json             poses: [{pose: 16 numbers, score, reliable}],
///     time_ms
///
/// Poses are T_camera_model, row by row, in metres.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/pose_errors.hpp"

#include "bop_recall.hpp"
#include "pose_judgement.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Where one part's scenes lie.
struct PartFolder
{
  std::string name;
  std::string path;
  std::vector<std::string> scenes;  ///< Names of the folders with a gt.json, sorted.
};

/// The parts of a data set that have scenes, by name.
/// @throw InputError if the folder cannot be read or holds none.
std::vector<PartFolder> listDataset(const std::string& path);

/// What the poses of a part are judged by.
struct JudgedPart
{
  PoseErrors errors;
  RenderableMesh mesh;  ///< [m]
};

/// @throw InputError if the part file or its mesh cannot be used.
JudgedPart loadJudgedPart(const PartFolder& folder);

/// Reads gt.json.
/// @throw InputError naming the file and what is wrong with it.
std::vector<TrueObject> loadTruth(const std::string& path);

/// Reads depth.png and camera.yaml of a scene.
/// @throw InputError if one of them cannot be used.
DepthView loadDepthView(const std::string& scene_folder);

/// What a result file says.
struct FoundPoses
{
  std::vector<ScoredPose> poses;
  double time_ms = 0;
};

/// Reads the result of one scene; nothing if the file is not there.
/// @throw InputError naming the file and what is wrong with it.
std::optional<FoundPoses> loadFoundPoses(const std::string& path);
}  // namespace ppf_bin_picking

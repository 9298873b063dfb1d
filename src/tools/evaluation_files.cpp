#include "evaluation_files.hpp"

#include "ppf_bin_picking/core/detector_config.hpp"

#include "ppf_bin_picking/io/depth_io.hpp"
#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"

#include "tool_support.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace fs = std::filesystem;
namespace
{
using nlohmann::json;
constexpr std::size_t kMaxJsonBytes = std::size_t{1} << 28;
constexpr std::size_t kPoseNumbers = 16;

/// Names of the folders in a folder, sorted.
std::vector<std::string> foldersIn(const std::string& path)
{
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
    if (entry.is_directory(error)) names.push_back(entry.path().filename().string());
  if (error) throw InputError(path + " is no folder that can be read: check the path");
  std::sort(names.begin(), names.end());
  return names;
}

/// Parses a file and reads it; whatever is wrong becomes one sentence.
/// @param kind  What the file should be, and the remedy, parted by a colon.
template <class Read>
auto readJson(const std::string& path, const std::string& kind, const std::string& remedy,
              const Read& read)
{
  const std::string text = readFile(path, kMaxJsonBytes);
  try
  {
    return read(json::parse(text));
  }
  catch (const std::exception& error)  // of the library, or one of ours
  {
    throw InputError(path + " is no " + kind + " (" + error.what() + "): " + remedy);
  }
}

/// The list of a key, each item read with its place in the messages.
template <class Item, class Read>
std::vector<Item> listOf(const json& root, const char* key, const char* name, const Read& read)
{
  if (!root.is_object() || !root.contains(key) || !root.at(key).is_array())
    throw std::invalid_argument(std::string("'") + key + "' is not a list");
  std::vector<Item> items;
  for (const json& item : root.at(key))
  {
    const std::string where = std::string(name) + " " + std::to_string(items.size());
    if (!item.is_object()) throw std::invalid_argument(where + " is not an object");
    items.push_back(read(item, where));
  }
  return items;
}

double numberOf(const json& item, const char* key, const std::string& where)
{
  if (!item.contains(key) || !item.at(key).is_number())
    throw std::invalid_argument(where + " has no number '" + key + "'");
  return item.at(key).get<double>();
}

std::vector<double> numbersOf(const json& item, const char* key, std::size_t count,
                              const std::string& where)
{
  const json numbers = item.value(key, json());
  const auto is_number = [](const json& value) { return value.is_number(); };
  if (!numbers.is_array() || numbers.size() != count ||
      !std::all_of(numbers.begin(), numbers.end(), is_number))
    throw std::invalid_argument("'" + std::string(key) + "' of " + where + " is not " +
                                std::to_string(count) + " numbers");
  return numbers.get<std::vector<double>>();
}

/// A matrix that need not be rigid.
Eigen::Isometry3d matrixOf(const json& item, const std::string& where)
{
  const std::vector<double> values = numbersOf(item, "pose", kPoseNumbers, where);
  Eigen::Isometry3d matrix = Eigen::Isometry3d::Identity();
  matrix.matrix().topRows<3>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(values.data());
  return matrix;
}

TrueObject objectOf(const json& item, const std::string& where)
{
  const TrueObject object = {matrixOf(item, where), numberOf(item, "visibility", where)};
  if (!isRigid(object.T_camera_model))
    throw std::invalid_argument("'pose' of " + where + " is no rigid transformation");
  return object;
}

Matrix6d covarianceOf(const json& item, const std::string& where)
{
  if (!item.contains("covariance")) return unknownCovariance();
  const std::vector<double> values = numbersOf(item, "covariance", 36, where);
  return Eigen::Map<const Matrix6d>(values.data());  // symmetric
}

ScoredPose poseOf(const json& item, const std::string& where)
{
  ScoredPose pose;
  pose.T_camera_model = matrixOf(item, where);
  pose.score = numberOf(item, "score", where);
  if (!item.contains("reliable") || !item.at("reliable").is_boolean())
    throw std::invalid_argument(where + " does not say true or false for 'reliable'");
  pose.reliable = item.at("reliable").get<bool>();
  pose.covariance = covarianceOf(item, where);
  return pose;
}
}  // namespace

std::vector<PartFolder> listDataset(const std::string& path)
{
  std::vector<PartFolder> parts;
  for (const std::string& name : foldersIn(path))
  {
    PartFolder part = {name, (fs::path(path) / name).string(), {}};
    if (!fs::is_regular_file(fs::path(part.path) / "part.yaml")) continue;
    for (const std::string& scene : foldersIn(part.path))
      if (fs::is_regular_file(fs::path(part.path) / scene / "gt.json"))
        part.scenes.push_back(scene);
    if (!part.scenes.empty()) parts.push_back(part);
  }
  if (parts.empty())
    throw InputError(path +
                     " holds no <part>/part.yaml with a <part>/<scene>/gt.json: give the folder "
                     "of a data set");
  return parts;
}

JudgedPart loadJudgedPart(const PartFolder& folder)
{
  const PartDescription part = loadPart((fs::path(folder.path) / "part.yaml").string());
  const LoadedMesh loaded = loadMesh(part.mesh_file, part.unit);
  for (const std::string& warning : loaded.warnings)
    report("warning: " + warning);
  return {PoseErrors(loadVertices(part.mesh_file, part.unit), part.symmetries()),
          RenderableMesh(loaded.mesh)};
}

std::vector<TrueObject> loadTruth(const std::string& path)
{
  const auto read = [](const json& root)
  { return listOf<TrueObject>(root, "objects", "object", objectOf); };
  return readJson(path, "ground truth", "write the data set again", read);
}

DepthView loadDepthView(const std::string& scene_folder)
{
  const DepthCamera camera = loadDepthCamera((fs::path(scene_folder) / "camera.yaml").string());
  const PointCloud cloud = loadDepthCloud((fs::path(scene_folder) / "depth.png").string(), camera,
                                          static_cast<std::size_t>(DetectorConfig().max_points));
  DepthView view = {camera.pinhole, {}};
  for (const Eigen::Vector3f& point : cloud.points)
    view.depth.push_back(std::isfinite(point.z()) ? point.z() : 0.0F);
  return view;
}

std::optional<FoundPoses> loadFoundPoses(const std::string& path)
{
  if (!fs::exists(path)) return std::nullopt;
  const auto read = [](const json& root)
  {
    FoundPoses found;
    found.poses = listOf<ScoredPose>(root, "poses", "pose", poseOf);
    found.time_ms = numberOf(root, "time_ms", "it");
    return found;
  };
  return readJson(path, "result of a detection", "run the detector again", read);
}
}  // namespace ppf_bin_picking

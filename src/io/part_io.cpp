#include "ppf_bin_picking/io/part_io.hpp"

#include "ppf_bin_picking/core/symmetry_check.hpp"
#include "ppf_bin_picking/core/symmetry_search.hpp"

#include "ppf_bin_picking/io/config_io.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include <cmath>
#include <filesystem>
#include <string>

namespace ppf_bin_picking
{
namespace fs = std::filesystem;
namespace
{
constexpr double kUnitTolerance = 1e-3;
constexpr double kTurnTolerance_deg = 0.01;  // of the angle: 51.43 is a seventh

Eigen::Vector3d vectorOf(const YamlMap& map, const std::string& key)
{
  return Eigen::Vector3d(map.numbers(key, 3).data());
}

SymmetryAxis readAxis(const YamlMap& map, double metres_per_unit)
{
  SymmetryAxis line;
  line.axis = vectorOf(map, "axis");
  if (!(line.axis.norm() > 0))
    throw InputError(map.where() + ": axis has no length: give a direction such as [0, 0, 1]");
  line.axis.normalize();
  if (map.has("point")) line.point = vectorOf(map, "point") * metres_per_unit;
  return line;
}

/// The angle of a discrete symmetry [rad]: the fraction k / n of the full turn, n up to kMaxTurns,
/// that the file's decimals mean.
double readTurn(const YamlMap& map)
{
  const double angle_deg = map.number("angle_deg");
  for (int n = 2; n <= kMaxTurns; ++n)
  {
    const double k = std::round(angle_deg * n / 360.0);
    if (std::abs(angle_deg - k * 360.0 / n) >= kTurnTolerance_deg) continue;
    if (std::fmod(k, n) == 0)
      throw InputError(map.where() + ": angle_deg is " + plainDecimal(angle_deg) +
                       ", which turns nothing: give 360 divided by the number of like positions");
    return k * 2 * M_PI / n;
  }
  throw InputError(map.where() + ": angle_deg is " + plainDecimal(angle_deg) +
                   ", which no number of turns up to " + std::to_string(kMaxTurns) +
                   " brings back: give 360 divided by the number of like positions");
}

Pick readPick(const YamlMap& map, double metres_per_unit)
{
  Pick pick;
  pick.name = map.text("name");
  const std::vector<double> pose = map.numbers("pose", 7);
  const Eigen::Quaterniond rotation(pose[6], pose[3], pose[4], pose[5]);
  if (std::abs(rotation.norm() - 1.0) > kUnitTolerance)
    throw InputError(map.where() + ": pose [x, y, z, qx, qy, qz, qw] has a quaternion of length " +
                     std::to_string(rotation.norm()) + ": give one of length 1");
  pick.T_model_pick.linear() = rotation.normalized().toRotationMatrix();
  pick.T_model_pick.translation() = Eigen::Vector3d(pose.data()) * metres_per_unit;
  return pick;
}

/// A path as a part file may give it.
std::string resolved(const std::string& given, const std::string& part_file, const std::string& key,
                     const PackageFinder& finder)
{
  if (isPackagePath(given)) return resolvedPackagePath(given, part_file + ": " + key, finder);
  return (fs::path(part_file).parent_path() / given).string();
}

std::string idOf(const std::string& path)
{
  const fs::path full = fs::absolute(path).lexically_normal();
  return full.filename() == "part.yaml" ? full.parent_path().filename().string()
                                        : full.stem().string();
}

void readSymmetries(const YamlMap& map, PartDescription& part)
{
  const double scale = metres(part.unit);
  part.states_symmetries = map.has("symmetries_discrete") || map.has("symmetries_continuous");
  for (const YamlMap& item : map.maps("symmetries_discrete", {"axis", "angle_deg", "point"}))
    part.symmetries_discrete.push_back({readAxis(item, scale), readTurn(item)});
  for (const YamlMap& item : map.maps("symmetries_continuous", {"axis", "point"}))
    part.symmetries_continuous.push_back(readAxis(item, scale));
  try
  {
    part.symmetries();
  }
  catch (const std::invalid_argument& error)
  {
    throw InputError(part.source + ": " + error.what());
  }
}
}  // namespace

DetectorConfig PartDescription::adapted(const DetectorConfig& config) const
{
  YAML::Node settings(YAML::NodeType::Map);
  for (const auto& [key, value] : detector)
    settings[key] = value;
  return withSettings(config, settings, source + ": detector");
}

PartDescription loadPart(const std::string& path, const PackageFinder& finder)
{
  const YamlMap map(loadYaml(path), path,
                    {"model_id", "mesh", "unit", "symmetries_discrete", "symmetries_continuous",
                     "picks", "model", "detector"});
  PartDescription part;
  part.source = path;
  if (!map.has("unit"))
    throw InputError(path +
                     ": unit is missing, and a mesh file does not know its own: add "
                     "'unit: mm' or 'unit: m'");
  part.unit = lengthUnitFromString(map.text("unit"), path + ": unit");
  part.model_id = map.has("model_id") ? map.text("model_id") : idOf(path);
  part.mesh_file = resolved(map.has("mesh") ? map.text("mesh") : "model.stl", path, "mesh", finder);
  if (map.has("model")) part.model_file = resolved(map.text("model"), path, "model", finder);
  readSymmetries(map, part);
  for (const YamlMap& item : map.maps("picks", {"name", "pose"}))
    part.picks.push_back(readPick(item, metres(part.unit)));
  if (map.has("detector"))
  {
    const YAML::Node settings = map.node("detector");
    withSettings(DetectorConfig(), settings, path + ": detector");
    for (const auto& item : settings)
      part.detector[item.first.Scalar()] = item.second.Scalar();
  }
  return part;
}

PartSymmetries symmetriesOf(const PartDescription& part, const TriangleMesh& mesh)
{
  try
  {
    PartSymmetries symmetries;
    const SymmetryGroup found = findSymmetries(mesh);
    symmetries.group = part.states_symmetries ? part.symmetries() : found;
    if (part.states_symmetries)
    {
      const std::string problem = symmetryProblem(mesh, symmetries.group);
      if (!problem.empty()) throw InputError(part.source + ": " + problem);
      const std::string unstated = unstatedSymmetries(symmetries.group, found, metres(part.unit));
      if (!unstated.empty())
        symmetries.warning = part.source + ": the mesh has symmetries that are not stated, " +
                             unstated +
                             ": poses that differ by them look the same, so that hardly any will "
                             "be reliable; state them as well, or leave the symmetries out to "
                             "have them found";
    }
    symmetries.summary =
        std::string("symmetries ") +
        (part.states_symmetries ? "stated, and confirmed by the mesh: " : "found in the mesh: ") +
        describe(symmetries.group, metres(part.unit));
    return symmetries;
  }
  catch (const std::invalid_argument& error)
  {
    throw InputError(part.mesh_file + ": " + error.what());
  }
}
}  // namespace ppf_bin_picking

#include "cell_params.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include "sensor_params.hpp"

#include <cstdlib>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMaxRate_hz = 100;

/// Reads values that may be left out, and requires that they lie in a range.
class Reader
{
public:
  explicit Reader(const YamlMap& map) : map_(map) {}

  void number(const std::string& key, double low, double high, double& value) const
  {
    if (!map_.has(key)) return;
    value = map_.number(key);
    if (!(value >= low && value <= high))
      refuse(key, plainDecimal(value), plainDecimal(low), plainDecimal(high));
  }
  void integer(const std::string& key, int low, int high, int& value) const
  {
    if (!map_.has(key)) return;
    value = map_.integer(key);
    if (value < low || value > high)
      refuse(key, std::to_string(value), std::to_string(low), std::to_string(high));
  }
  void text(const std::string& key, std::string& value) const
  {
    if (map_.has(key)) value = map_.text(key);
  }
  void vector(const std::string& key, Eigen::Vector3d& value) const
  {
    if (map_.has(key)) value = Eigen::Vector3d(map_.numbers(key, 3).data());
  }

private:
  [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& low,
                           const std::string& high) const
  {
    throw InputError(map_.where() + ": " + key + " is " + value + ": give a value from " + low +
                     " to " + high);
  }

  const YamlMap& map_;
};

void readBin(const YamlMap& map, CellSettings& cell)
{
  const Reader reader(map);
  reader.vector("size_m", cell.bin.size_m);
  reader.number("wall_m", 0.0001, 1, cell.bin.wall_m);
  reader.vector("position_m", cell.bin_position_m);
  if (!(cell.bin.size_m.minCoeff() > 0 && cell.bin.size_m.maxCoeff() <= 10))
    throw InputError(map.where() +
                     ": size_m is out of range: give three lengths above 0, in metres");
}

void readCamera(const YamlMap& map, CellSettings& cell)
{
  const Reader reader(map);
  reader.vector("position_m", cell.camera_position_m);
  reader.vector("target_m", cell.camera_target_m);
}

void readPick(const YamlMap& map, PickRule& rule)
{
  const Reader reader(map);
  reader.number("tolerance_rel", 0.001, 1, rule.tolerance_rel);
  reader.number("contact_m", 0.0001, 0.1, rule.contact_m);
  reader.number("push_rel", 0.01, 1, rule.push_rel);
}

/// The folder given, or where programs of this user keep what they can compute anew.
std::string cacheFolder(const CellParams& params)
{
  const char* const home = std::getenv("HOME");
  if (!params.cache_folder.empty() || home == nullptr) return params.cache_folder;
  return std::string(home) + "/.cache/ppf_bin_picking";
}
}  // namespace

CellParams readCellParams(const YAML::Node& node, const std::string& where)
{
  const YamlMap map(node, where,
                    {"part", "count", "seed", "rate_hz", "cache_folder", "base_frame", "bin_frame",
                     "camera_frame", "bin", "camera", "sensor", "pick"});
  CellParams params;
  params.part = map.text("part");
  const Reader reader(map);
  reader.integer("count", 0, CellParams::kMaxParts, params.count);
  reader.integer("seed", 0, CellParams::kMaxSeed, params.seed);
  reader.number("rate_hz", 0, kMaxRate_hz, params.rate_hz);
  reader.text("cache_folder", params.cache_folder);
  reader.text("base_frame", params.base_frame);
  reader.text("bin_frame", params.bin_frame);
  reader.text("camera_frame", params.camera_frame);
  if (map.has("bin")) readBin(map.map("bin", {"size_m", "wall_m", "position_m"}), params.cell);
  if (map.has("camera")) readCamera(map.map("camera", {"position_m", "target_m"}), params.cell);
  if (map.has("sensor")) params.cell.sensor = readDepthSensor(map.map("sensor", depthSensorKeys()));
  if (map.has("pick"))
    readPick(map.map("pick", {"tolerance_rel", "contact_m", "push_rel"}), params.cell.pick);
  return params;
}

LoadedCellPart loadCellPart(const CellParams& params)
{
  const PartDescription description = loadPart(params.part);
  LoadedMesh loaded = loadMesh(description.mesh_file, description.unit);
  LoadedCellPart result;
  result.model_id = description.model_id;
  result.warnings = loaded.warnings;
  const std::string folder = cacheFolder(params);
  result.part.hulls =
      folder.empty() ? convexHulls(loaded.mesh) : cachedConvexHulls(loaded.mesh, folder);
  result.part.symmetries = symmetriesOf(description, loaded.mesh).group;
  result.part.mesh = std::move(loaded.mesh);
  return result;
}
}  // namespace ppf_bin_picking

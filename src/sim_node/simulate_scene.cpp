/// @file simulate_scene: part, count, sensors and seed in, scenes of a data set out.
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/sim/cell_layout.hpp"
#include "ppf_bin_picking/sim/part_pile.hpp"

#include "cell_params.hpp"
#include "scene_files.hpp"
#include "tool_support.hpp"

#include <algorithm>
#include <sstream>

namespace ppf_bin_picking
{
namespace
{
constexpr int kMaxParts = 500;

struct Options
{
  std::string part;
  int count = 0;
  std::vector<std::string> presets = {"industrial"};
  std::uint32_t seed = 1;
  std::string output;
  std::string hulls;
};

TriangleMesh meshOf(const PartDescription& part)
{
  LoadedMesh loaded = loadMesh(part.mesh_file, part.unit);
  for (const std::string& warning : loaded.warnings)
    report("warning: " + warning);
  return std::move(loaded.mesh);
}

/// Where the parts lie: T_bin_part.
std::vector<Eigen::Isometry3d> pileOf(const TriangleMesh& part, const Options& options)
{
  PartPile pile(binFor(part, options.count), part,
                options.hulls.empty() ? convexHulls(part) : cachedConvexHulls(part, options.hulls));
  pile.drop(options.count, options.seed);
  return pile.poses();
}

/// Looks at a pile.
SceneShot shotOf(const TriangleMesh& part, const std::vector<Eigen::Isometry3d>& T_bin_parts,
                 const DepthSensor& sensor, std::uint32_t seed)
{
  SceneShot shot;
  shot.cell = cellFor(part, static_cast<int>(T_bin_parts.size()), sensor);
  shot.T_bin_camera = lookAt(shot.cell.camera_position_m, shot.cell.camera_target_m);
  const TriangleMesh bin = binMesh(shot.cell.bin);
  std::vector<PlacedMesh> meshes = {{&bin, Eigen::Isometry3d::Identity()}};
  for (const Eigen::Isometry3d& T_bin_part : T_bin_parts)
    meshes.push_back({&part, T_bin_part});
  shot.view = takeShot(RayCaster(meshes), sensor, shot.T_bin_camera, seed);
  shot.parts = partTruths(shot.view, sensor.camera, shot.T_bin_camera, part, T_bin_parts, 1);
  return shot;
}

void reportScene(const std::string& folder, const SceneShot& shot)
{
  const auto half_visible =
      std::count_if(shot.parts.begin(), shot.parts.end(),
                    [](const auto& part) { return part.visible_share >= 0.5; });
  std::ostringstream line;
  line << "wrote " << folder << ": " << shot.parts.size() << " parts in a bin of "
       << shot.cell.bin.size_m.transpose() << " m, " << half_visible << " at least half visible";
  report(line.str());
}

void simulateScene(const Options& options)
{
  const PartDescription part = loadPart(options.part);
  const TriangleMesh mesh = meshOf(part);
  const std::string part_folder = options.output + "/" + part.model_id;
  requireSamePart(part_folder, part);
  makeFolder(part_folder);
  report("dropping " + std::to_string(options.count) + " parts of " + part.model_id + " ...");
  const std::vector<Eigen::Isometry3d> T_bin_parts = pileOf(mesh, options);
  writePart(part_folder, part);
  for (const std::string& preset : options.presets)
  {
    const std::string folder = part_folder + "/" + preset + "-" + std::to_string(options.count) +
                               "-" + std::to_string(options.seed);
    const SceneShot shot = shotOf(mesh, T_bin_parts, sensorPreset(preset), options.seed);
    writeScene(folder, shot);
    reportScene(folder, shot);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app(
      "Drops parts into a bin of fitting size, looks at them with simulated depth cameras and "
      "writes depth image, camera, region of interest and truth.",
      "simulate_scene");
  Options options;
  app.add_option("--part", options.part, "Part file: mesh, unit, symmetries")->required();
  app.add_option("--count", options.count, "Parts in the bin")
      ->required()
      ->check(CLI::Range(1, kMaxParts));
  app.add_option("--preset", options.presets,
                 "Sensors: clean, industrial (default), low_cost; one scene each, of the same pile")
      ->check(CLI::IsMember(sensorPresetNames()));
  app.add_option("--seed", options.seed, "The same seed gives the same scene; default 1")
      ->check(CLI::Range(0, CellParams::kMaxSeed));
  app.add_option("--output", options.output,
                 "Data set's folder; scenes go to <output>/<part>/<preset>-<count>-<seed>")
      ->required();
  app.add_option("--hulls", options.hulls,
                 "Folder that keeps the part's convex hulls for the next time");
  return runTool(app, argc, argv, [&] { simulateScene(options); });
}

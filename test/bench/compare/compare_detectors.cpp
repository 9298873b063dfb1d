/// @file compare_detectors: this detector and those of PCL and OpenCV on the same scenes of one
/// part, each run in a child of this process. scripts/compare runs it and explains the result.
#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/result_io.hpp"

#include "contained.hpp"
#include "peers.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
struct Options
{
  std::string part;                 ///< Folder with part.yaml.
  std::vector<std::string> scenes;  ///< Folders with depth.png, camera.yaml and roi.yaml.
  std::string results;
  std::string fast, accurate;  ///< Settings of this detector.
  std::vector<std::string> peers = {"fast", "accurate", "PCL", "OpenCV"};
  unsigned limit_s = 600;
  int repeat = 5;
  double opencv_scene_step = 0.03;
  bool facts = false;
};

std::unique_ptr<Peer> makePeer(const std::string& name, const Options& options)
{
  if (name == "PCL") return pclPeer();
  if (name == "OpenCV") return opencvPeer(options.opencv_scene_step);
  return ownPeer(options.repeat);
}

ToolPart partFor(const std::string& peer, const Options& options)
{
  PartOptions part;
  part.part = options.part + "/part.yaml";
  if (peer == "fast") part.config = options.fast;
  if (peer == "accurate") part.config = options.accurate;
  return part.load();
}

std::string resultPath(const std::string& peer, const std::string& scene, const Options& options)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(options.results) / peer / fs::path(options.part).filename();
  fs::create_directories(folder);
  return (folder / fs::path(scene).filename()).string() + ".json";
}

/// The region's points in a voxel grid, from the image at the camera's own resolution.
OrientedPoints voxelsOf(const PeerScene& scene, double diameter_m)
{
  RangeImageOptions options;
  options.diameter_m = options.largest_diameter_m = diameter_m;
  options.pixels_per_diameter = std::numeric_limits<float>::max();
  return sampleScene(makeRangeImage(scene.cloud, scene.region, options).image,
                     static_cast<float>(kVoxelRel * diameter_m));
}

PeerScene loadPeerScene(const std::string& folder, const ToolPart& part, const Peer& peer)
{
  SceneOptions files;
  files.depth = folder + "/depth.png";
  files.camera = folder + "/camera.yaml";
  files.roi = folder + "/roi.yaml";
  Scene loaded = files.load(static_cast<std::size_t>(part.config.max_points));
  PeerScene scene;
  scene.cloud = std::move(loaded.cloud);
  scene.region = *loaded.roi;
  if (peer.wantsVoxels()) scene.voxels = voxelsOf(scene, meshDiameter(part.mesh));
  return scene;
}

void writeResult(const std::string& path, const PeerResult& peer, double train_s,
                 const std::string& failure)
{
  ResultFile file;
  file.train_seconds = train_s;
  file.result = peer.result;
  nlohmann::json root = nlohmann::json::parse(toJson(file));
  root["failure"] = failure;
  root["cores"] = peer.cores;
  root["points"] = peer.points;
  root["peak_mb"] = peer.peak_mb;
  root["runs_ms"] = nlohmann::json::array();
  for (const StageTime& run : peer.runs)
    root["runs_ms"].push_back(run.seconds * 1000);
  writeFile(path, root.dump(1) + "\n");
}

/// Runs one scene in a child. What fails there is written by the parent.
void runScene(const std::string& name, const std::string& folder, const Options& options,
              const ToolPart& part, double train_s, Peer& peer)
{
  const std::string path = resultPath(name, folder, options);
  const auto detect = [&]
  {
    const PeerScene scene = loadPeerScene(folder, part, peer);
    restartLimit(options.limit_s);
    PeerResult found = peer.detect(scene);
    found.peak_mb = peakMemory_mb();
    writeResult(path, found, train_s, "");
  };
  const std::string failure = runContained(options.limit_s, detect);
  if (!failure.empty()) writeResult(path, {}, train_s, failure);
  report(name + ", " + folder + (failure.empty() ? ": done" : ": " + failure));
}

/// Trains, then runs the scenes, all of it in a child.
void runPeer(const std::string& name, const Options& options)
{
  const auto work = [&]
  {
    const ToolPart part = partFor(name, options);
    const std::unique_ptr<Peer> peer = makePeer(name, options);
    const auto start = std::chrono::steady_clock::now();
    peer->train(part);
    const double train_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    restartLimit(0);
    for (const std::string& folder : options.scenes)
      runScene(name, folder, options, part, train_s, *peer);
  };
  const std::string failure = runContained(options.limit_s, work);
  if (failure.empty()) return;
  for (const std::string& folder : options.scenes)
    writeResult(resultPath(name, folder, options), {}, 0, "training " + failure);
  report(name + ": training " + failure);
}
void addOptions(Options& options, CLI::App& app)
{
  app.add_flag("--facts", options.facts, "Print versions and build as JSON, do nothing else");
  app.add_option("--part", options.part, "Folder with part.yaml");
  app.add_option("--scenes", options.scenes, "Folders with depth.png, camera.yaml and roi.yaml");
  app.add_option("--fast", options.fast, "Settings of this detector, its fast row");
  app.add_option("--accurate", options.accurate, "Settings of this detector, its accurate row");
  app.add_option("--results", options.results, "Folder for <peer>/<part>/<scene>.json");
  app.add_option("--peers", options.peers, "Some of fast, accurate, PCL, OpenCV")
      ->check(CLI::IsMember(options.peers));
  app.add_option("--time-limit", options.limit_s, "Seconds of one training or one detection")
      ->check(CLI::Range(1, 86400));
  app.add_option("--repeat", options.repeat, "Runs of this detector; the median one counts")
      ->check(CLI::Range(1, 1000));
  app.add_option("--opencv-scene-step", options.opencv_scene_step,
                 "OpenCV's sampling of the scene, relative to the scene's extent")
      ->check(CLI::Range(0.001, 1.0));
}

void compare(const Options& options)
{
  if (options.facts)
    std::cout << buildFacts() << "\n";
  else if (options.part.empty() || options.scenes.empty() || options.results.empty())
    throw InputError("nothing to compare: give --part, --scenes and --results");
  else
    for (const std::string& peer : options.peers)
      runPeer(peer, options);
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app("Compares detectors on scenes of one part.", "compare_detectors");
  Options options;
  addOptions(options, app);
  return runTool(app, argc, argv, [&] { compare(options); });
}

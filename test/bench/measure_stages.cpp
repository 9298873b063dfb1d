/// @file measure_stages: each stage of a detection by Google Benchmark, on one thread and on fixed
/// piles of parts of the package. CONTRIBUTING.md explains the counters.
#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/dbscan.hpp"
#include "ppf_bin_picking/core/detector.hpp"
#include "ppf_bin_picking/core/evidence_climb.hpp"
#include "ppf_bin_picking/core/normals.hpp"
#include "ppf_bin_picking/core/pose_clustering.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"
#include "ppf_bin_picking/core/ppf_matcher.hpp"
#include "ppf_bin_picking/core/selection.hpp"
#include "ppf_bin_picking/core/sparse_fit.hpp"

#include "ppf_bin_picking/io/model_io.hpp"

#include "bench_pile.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
using benchmark::Counter;
using benchmark::State;

constexpr float kNormalGateRel = 0.05F;  // as the detector's

/// A part and its pile, made when first asked for.
struct Input
{
  explicit Input(const std::string& name) : part(name), pile(part) {}
  BenchPart part;
  BenchPile pile;
};

const Input& inputOf(const std::string& part)
{
  static std::map<std::string, std::unique_ptr<Input>> inputs;
  std::unique_ptr<Input>& input = inputs[part];
  if (!input) input = std::make_unique<Input>(part);
  return *input;
}

/// Counts things a second; all of it is done in each iteration.
void countRate(State& state, const char* name, std::size_t per_iteration)
{
  state.counters[name] =
      Counter(static_cast<double>(per_iteration), Counter::kIsIterationInvariantRate);
}

void training(State& state, const Input& input)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(
        PpfModel::train(input.part.mesh, input.part.symmetries, input.part.config.model));
  state.counters["pairs"] = static_cast<double>(input.part.model.data().entries.size());
}

void preparation(State& state, const Input& input)
{
  const RangeImageOptions options = imageOptions(input.part);
  for (auto _ : state)
    benchmark::DoNotOptimize(makeRangeImage(input.pile.cloud, input.pile.region, options));
  countRate(state, "points/s", input.pile.cloud.size());
}

void normals(State& state, const Input& input)
{
  RangeImage image = input.pile.image;
  const float gate_m = kNormalGateRel * static_cast<float>(input.part.model.diameter());
  for (auto _ : state)
  {
    estimateImageNormals(image, input.part.config.normal_radius_px, gate_m, 1);
    benchmark::DoNotOptimize(image.normals.data());
  }
  countRate(state, "pixels/s", image.depth.size());
}

void sampling(State& state, const Input& input)
{
  const auto step_m =
      static_cast<float>(input.part.config.model.step_rel * input.part.model.diameter());
  for (auto _ : state)
    benchmark::DoNotOptimize(sampleScene(input.pile.image, step_m));
  state.counters["points"] = static_cast<double>(input.pile.scene.size());
}

void voting(State& state, const Input& input)
{
  const auto& [part, pile] = std::tie(input.part, input.pile);
  for (auto _ : state)
    benchmark::DoNotOptimize(matchModel(pile.scene, part.model, part.config, Deadline()));
  const VoteCount count = countVotes(pile.scene, part.model, part.config);
  countRate(state, "pairs/s", count.pairs);
  countRate(state, "votes/s", count.votes);
}

void boundaryVoting(State& state, const Input& input)
{
  const auto& [part, pile] = std::tie(input.part, input.pile);
  for (auto _ : state)
    benchmark::DoNotOptimize(boundaryHypotheses(pile.image, part.model, part.config, Deadline()));
}

void clustering(State& state, const Input& input)
{
  std::vector<Eigen::Vector3f> centers;
  for (const PoseHypothesis& hypothesis : input.pile.hypotheses)
    centers.push_back(hypothesis.center);
  const auto eps_m = static_cast<float>(dbscanRadius(input.part.config, input.part.model));
  const std::size_t minpts = dbscanCoreSize(input.part.config, input.part.model);
  for (auto _ : state)
    benchmark::DoNotOptimize(dbscan(centers, eps_m, minpts));
  countRate(state, "points/s", centers.size());
}

void grouping(State& state, const Input& input)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(
        groupPoses(input.part.config, input.part.model, input.pile.hypotheses));
  countRate(state, "poses/s", input.pile.hypotheses.size());
}

/// A stage that works on one pose after the other.
template <class Stage>
void perPose(State& state, const Input& input, const std::vector<Eigen::Isometry3f>& poses,
             const Stage& stage)
{
  const auto& [part, pile] = std::tie(input.part, input.pile);
  for (auto _ : state)
    for (const Eigen::Isometry3f& T_camera_model : poses)
      benchmark::DoNotOptimize(stage(pile.image, part.model, T_camera_model, part.config));
  countRate(state, "poses/s", poses.size());
}

void pruning(State& state, const Input& input)
{
  perPose(state, input, input.pile.shifted_T, fitSparsely);
}

void refinement(State& state, const Input& input)
{
  perPose(state, input, input.pile.shifted_T, refinePose);
}

void verification(State& state, const Input& input)
{
  perPose(state, input, input.pile.true_T, gatherEvidence);
  countRate(state, "pixels/s", countPixels(input.pile.image, input.part.model, input.pile.true_T));
}

/// Climbs from poses that are off: of poses that hold, few climb.
void climbing(State& state, const Input& input)
{
  const auto& [part, pile] = std::tie(input.part, input.pile);
  std::vector<PoseEvidence> evidence;
  for (const Eigen::Isometry3f& T_camera_model : pile.shifted_T)
    evidence.push_back(gatherEvidence(pile.image, part.model, T_camera_model, part.config));
  for (auto _ : state)
    for (std::size_t i = 0; i < evidence.size(); ++i)
      benchmark::DoNotOptimize(
          climbEvidence(pile.image, part.model, pile.shifted_T[i], evidence[i], part.config));
  countRate(state, "poses/s", evidence.size());
}

void selection(State& state, const Input& input)
{
  const auto& [part, pile] = std::tie(input.part, input.pile);
  std::vector<PoseEvidence> evidence;
  for (const std::vector<Eigen::Isometry3f>* poses : {&pile.true_T, &pile.shifted_T})
    for (const Eigen::Isometry3f& T_camera_model : *poses)
      evidence.push_back(gatherEvidence(pile.image, part.model, T_camera_model, part.config));
  std::vector<const PoseEvidence*> pointers;
  for (const PoseEvidence& one : evidence)
    pointers.push_back(&one);
  for (auto _ : state)
    benchmark::DoNotOptimize(selectPoses(pointers, pile.image.depth.size()));
  countRate(state, "poses/s", evidence.size());
}

void whole(State& state, const Input& input)
{
  const Detector detector(input.part.config);
  DetectionResult result;
  for (auto _ : state)
    result = detector.detect(input.pile.cloud, input.part.model, input.pile.region);
  state.counters["reliable"] =
      static_cast<double>(std::count_if(result.poses.begin(), result.poses.end(),
                                        [](const DetectedPose& pose) { return pose.reliable; }));
}

/// A whole detection of the part's pile, looking for more and more parts.
void models(State& state)
{
  const char* const names[] = {"tee",   "cylinder", "box",   "bracket",
                               "elbow", "plate",    "shaft", "bolt"};
  static std::map<std::string, std::unique_ptr<BenchPart>> parts;
  std::vector<const PpfModel*> loaded;
  for (std::int64_t i = 0; i < state.range(0); ++i)
  {
    std::unique_ptr<BenchPart>& part = parts[names[i]];
    if (!part) part = std::make_unique<BenchPart>(names[i]);
    loaded.push_back(&part->model);
  }
  const Input& input = inputOf(names[0]);
  const Detector detector(input.part.config);
  for (auto _ : state)
    benchmark::DoNotOptimize(detector.detect(input.pile.cloud, loaded, input.pile.region));
}

/// Reading a model file.
void loading(State& state, const Input& input)
{
  const std::string path = std::filesystem::temp_directory_path() / "measure_stages.ppf";
  saveModel(path, input.part.model, 0);
  for (auto _ : state)
    benchmark::DoNotOptimize(loadModel(path));
  std::remove(path.c_str());
}

using Stage = void (*)(State&, const Input&);
constexpr std::pair<const char*, Stage> kStages[] = {
    {"training", training},     {"loading", loading},       {"preparation", preparation},
    {"normals", normals},       {"sampling", sampling},     {"voting", voting},
    {"clustering", clustering}, {"grouping", grouping},     {"boundary_voting", boundaryVoting},
    {"pruning", pruning},       {"refinement", refinement}, {"verification", verification},
    {"selection", selection},   {"climbing", climbing},     {"whole", whole}};

void addBenchmarks()
{
  for (const auto& named : kStages)
    for (const std::string part : {"tee", "cylinder", "box"})
    {
      const Stage stage = named.second;
      benchmark::RegisterBenchmark((named.first + ("/" + part)).c_str(),
                                   [stage, part](State& state) { stage(state, inputOf(part)); })
          ->Unit(benchmark::kMillisecond);
    }
  benchmark::RegisterBenchmark("models", models)->DenseRange(1, 8)->Unit(benchmark::kMillisecond);
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  ppf_bin_picking::addBenchmarks();
  benchmark::RunSpecifiedBenchmarks();
}

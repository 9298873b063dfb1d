/// @file detect_poses: part and cloud in, poses out.
#include "ppf_bin_picking/core/detector.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/model_io.hpp"
#include "ppf_bin_picking/io/result_io.hpp"

#include "pose_explanation.hpp"
#include "tool_support.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
struct Options
{
  PartOptions part;
  SceneOptions scene;
  std::string model;
  int threads = -1;  ///< -1: as the configuration says.
  int repeat = 1;    ///< Detections of the same cloud.
  std::string output;
  std::string explain;       ///< A pose to explain ...
  bool has_explain = false;  ///< ... if there is one.
};

/// The model file's content, or a model trained now and the seconds it took.
PpfModel modelFor(const ToolPart& part, const Options& options, double& train_seconds)
{
  if (!options.model.empty())
  {
    ModelFile file = loadModel(options.model);
    requireFit(file, part.description, part.mesh_checksum);
    const std::string problem = modelProblem(file.model, part.config, std::nullopt);
    if (!problem.empty()) throw InputError(options.model + ": " + problem);
    return std::move(file.model);
  }
  const auto start = std::chrono::steady_clock::now();
  PpfModel model = trainedModel(part);
  train_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return model;
}

void reportTimes(const DetectionResult& result)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  for (const StageTime& stage : result.stages)
    text << std::setw(9) << stage.seconds * 1000 << " ms  " << stage.name << "\n";
  text << std::setw(9) << result.seconds * 1000 << " ms  in all";
  report(text.str());
}

/// The time that a share of the detections stay within.
double quantile(const std::vector<double>& ascending, double share)
{
  const double rank = std::ceil(share * static_cast<double>(ascending.size()));
  return ascending[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

/// What several detections of the same cloud took.
void reportDistribution(std::vector<double> seconds)
{
  const double first = seconds.front();
  std::sort(seconds.begin(), seconds.end());
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << seconds.size() << " detections: first "
       << first * 1000 << " ms, least " << seconds.front() * 1000 << ", median "
       << quantile(seconds, 0.5) * 1000 << ", 95 % within " << quantile(seconds, 0.95) * 1000
       << ", most " << seconds.back() * 1000;
  report(text.str());
}

void detectPoses(const Options& options)
{
  std::optional<Eigen::Isometry3d> explained;
  if (options.has_explain) explained = poseFromText(options.explain);
  requireWritable(options.output);
  ToolPart part = options.part.load(options.output);
  if (options.threads >= 0) part.config.threads = options.threads;
  const Detector detector(part.config);
  const Scene scene =
      options.scene.load(static_cast<std::size_t>(part.config.max_points), options.output);
  requireNoInput(options.output, {options.model});
  ResultFile file;
  file.frame_id = scene.frame_id;
  file.model_id = part.description.model_id;
  const PpfModel model = modelFor(part, options, file.train_seconds);
  PoseExplanation explanation;
  std::vector<double> seconds;
  for (int i = 0; i < options.repeat; ++i)
  {
    if (explained)
    {
      explanation = detector.explain(scene.cloud, model, scene.roi, *explained);
      file.result = explanation.result;
    }
    else
      file.result = detector.detect(scene.cloud, model, scene.roi);
    seconds.push_back(file.result.seconds);
  }
  if (file.result.status == DetectionStatus::kBadCloud) throw InputError(file.result.message);
  writeFile(options.output, toJson(file));
  if (!scene.roi)
    report(
        "warning: no region of interest is given, so that the bin's walls and all around it "
        "were searched, too: give the inside of the bin by --roi");
  reportTimes(file.result);
  if (options.repeat > 1) reportDistribution(seconds);
  report(file.result.message);
  if (explained) std::cout << explanationText(explanation, part.config);
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app("Finds a part in one cloud and writes its poses.", "detect_poses");
  Options options;
  options.part.add(app);
  app.add_option("--model", options.model, "Model of train_model; without it the part is trained");
  options.scene.add(app);
  app.add_option("--threads", options.threads,
                 "Threads instead of the configuration's; 0: one per core")
      ->check(CLI::Range(0, 1024));
  CLI::Option* explain =
      app.add_option("--explain", options.explain,
                     "Pose \"x y z qx qy qz qw\", T_cloud_model in metres, to explain");
  app.add_option("--repeat", options.repeat,
                 "Detect so many times and print the distribution of the times; the result is the "
                 "last one's")
      ->check(CLI::Range(1, 100000));
  app.add_option("--output", options.output, "Result to write, .json")->required();
  return runTool(app, argc, argv,
                 [&]
                 {
                   options.has_explain = explain->count() > 0;
                   detectPoses(options);
                 });
}

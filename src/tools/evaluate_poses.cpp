/// @file evaluate_poses: the poses found in a data set against its ground truth.
#include "ppf_bin_picking/core/parallel.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include "evaluation_files.hpp"
#include "evaluation_report.hpp"
#include "tool_support.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace ppf_bin_picking
{
namespace
{
struct Options
{
  std::string dataset;
  std::string results;
  std::string json;
  JudgementRules rules;
};

JudgedScene judgeScene(const std::string& folder, const std::string& name,
                       const std::optional<FoundPoses>& found, const JudgedPart& part,
                       const JudgementRules& rules)
{
  JudgedScene scene;
  scene.name = name;
  const std::vector<TrueObject> objects = loadTruth(folder + "/gt.json");
  const DepthView view = loadDepthView(folder);
  std::vector<TrueObject> targets;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(targets),
               [&](const TrueObject& object) { return isTarget(object, rules); });
  scene.targets = targets.size();
  if (!found) return scene;
  scene.time_ms = found->time_ms;
  scene.poses = judgePoses(found->poses, objects, part.errors, rules);
  std::vector<ScoredPose> reliable;
  std::copy_if(found->poses.begin(), found->poses.end(), std::back_inserter(reliable),
               [](const ScoredPose& pose) { return pose.reliable; });
  scene.recalled = recalledTargets(reliable, targets, part.errors, part.mesh, view);
  return scene;
}

PartEvaluation evaluatePart(const PartFolder& folder, const Options& options,
                            std::vector<std::string>& missing)
{
  const JudgedPart part = loadJudgedPart(folder);
  std::vector<std::optional<FoundPoses>> found;
  for (const std::string& scene : folder.scenes)
  {
    const std::string path = options.results + "/" + folder.name + "/" + scene + ".json";
    found.push_back(loadFoundPoses(path));
    if (!found.back()) missing.push_back(path);
  }
  PartEvaluation evaluation = {folder.name, std::vector<JudgedScene>(folder.scenes.size())};
  parallelFor(0, folder.scenes.size(),
              [&](std::size_t i)
              {
                const std::string& scene = folder.scenes[i];
                evaluation.scenes[i] =
                    judgeScene(folder.path + "/" + scene, scene, found[i], part, options.rules);
              });
  return evaluation;
}

/// Every file of the data set, and every result that is looked for.
std::vector<std::string> inputsOf(const Options& options)
{
  std::vector<std::string> inputs;
  const auto addFiles = [&](const std::string& folder)
  {
    for (const auto& item : std::filesystem::directory_iterator(folder))
      inputs.push_back(item.path().string());
  };
  for (const PartFolder& folder : listDataset(options.dataset))
  {
    addFiles(folder.path);
    for (const std::string& scene : folder.scenes)
    {
      addFiles(folder.path + "/" + scene);
      inputs.push_back(options.results + "/" + folder.name + "/" + scene + ".json");
    }
  }
  return inputs;
}

void evaluatePoses(const Options& options)
{
  if (!options.json.empty())
  {
    requireWritable(options.json);
    requireNoInput(options.json, inputsOf(options));
  }
  std::vector<PartEvaluation> parts;
  std::vector<std::string> missing;
  std::size_t scenes = 0;
  for (const PartFolder& folder : listDataset(options.dataset))
  {
    parts.push_back(evaluatePart(folder, options, missing));
    scenes += folder.scenes.size();
  }
  if (missing.size() == scenes)
    throw InputError(options.results +
                     " holds no <part>/<scene>.json for a scene of the data set: give the folder "
                     "of its results");
  for (const std::string& path : missing)
    report("missing result, counted as nothing found: " + path);
  const NamedSummaries summaries = summariseParts(parts);
  std::fputs(tableText(summaries).c_str(), stdout);
  if (!options.json.empty())
    writeFile(options.json, evaluationJson(parts, summaries, options.rules));
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app("Scores the poses found in a data set against its ground truth.", "evaluate_poses");
  Options options;
  app.add_option("dataset", options.dataset,
                 "Folder with <part>/part.yaml and <part>/<scene>/gt.json, depth.png, camera.yaml")
      ->required();
  app.add_option("results", options.results, "Folder with <part>/<scene>.json of detect_poses")
      ->required();
  app.add_option("--threshold", options.rules.threshold_rel,
                 "Share of the diameter below which the MSSD of a right pose lies; 0.1")
      ->check(numberWithin(1e-6, 1));
  app.add_option("--min-visibility", options.rules.min_visibility,
                 "Visible share from which on an object is to be found; 0.5")
      ->check(numberWithin(0, 1));
  app.add_option("--json", options.json, "Figures, curves and the verdict on each pose to write");
  app.footer(columnHelp());
  return runTool(app, argc, argv, [&] { evaluatePoses(options); });
}

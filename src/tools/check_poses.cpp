/// @file check_poses: a table and a picture by which a person judges poses.
#include "ppf_bin_picking/core/range_image.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/result_io.hpp"

#include "pose_check.hpp"
#include "pose_drawing.hpp"
#include "tool_support.hpp"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

namespace ppf_bin_picking
{
namespace
{
struct Options
{
  std::string result;
  PartOptions part;
  SceneOptions scene;
  std::string image;
  bool all = false;
};

/// A pose with its place in the result file.
struct ListedPose
{
  std::size_t index;
  const DetectedPose* pose;
  Eigen::Isometry3f T_camera_model;
};

void printTable(const std::vector<ListedPose>& poses, const std::vector<PoseCheck>& checks)
{
  std::printf("%4s %6s %8s %8s %8s %-18s %8s %14s  %s\n", "pose", "score", "RMSE mm", "both mm",
              "turned", "turn", "through", "overlap", "verdict");
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    const PoseCheck& check = checks[i];
    std::array<char, 32> turned = {'-', 0};
    std::array<char, 32> overlap = {'-', 0};
    if (check.turned_m >= 0)
      std::snprintf(turned.data(), turned.size(), "%.3f", check.turned_m * 1000);
    if (check.overlap_with >= 0)
      std::snprintf(overlap.data(), overlap.size(), "%.1f%% of %zu", check.overlap * 100,
                    poses[static_cast<std::size_t>(check.overlap_with)].index);
    std::printf("%4zu %6.3f %8.3f %8.3f %8s %-18s %7.1f%% %14s  %s\n", poses[i].index,
                poses[i].pose->score, check.rmse_m * 1000, check.both_ways_m * 1000, turned.data(),
                check.turn.c_str(), check.looked_through * 100, overlap.data(),
                check.verdict.c_str());
  }
  const auto suspicious = std::count_if(checks.begin(), checks.end(),
                                        [](const PoseCheck& c) { return c.verdict != "ok"; });
  std::printf("%zu poses, %td suspicious\n", poses.size(), suspicious);
}

void writePicture(const std::string& path, const RangeImage& image, const PpfModel& model,
                  const std::vector<ListedPose>& poses)
{
  std::vector<DrawnPose> drawn;
  for (const ListedPose& item : poses)
    drawn.push_back({item.T_camera_model, item.pose->reliable, std::to_string(item.index)});
  std::vector<unsigned char> png;
  cv::imencode(".png", drawPoses(image, model.renderable(), drawn), png);
  writeFile(path, std::string(png.begin(), png.end()));
  report("wrote " + path);
}

void checkPoses(const Options& options)
{
  if (!options.image.empty()) requireWritable(options.image);
  requireNoInput(options.image, {options.result});
  const ResultFile file = loadResult(options.result);
  const ToolPart part = options.part.load(options.image);
  if (!file.model_id.empty() && file.model_id != part.description.model_id)
    throw InputError(options.result + " holds poses of the part '" + file.model_id + "', not of '" +
                     part.description.model_id + "': give its part file");
  const Scene scene =
      options.scene.load(static_cast<std::size_t>(part.config.max_points), options.image);
  const PpfModel model = trainedModel(part);
  const RangeImage image =
      makeRangeImage(
          scene.cloud, scene.roi,
          {model.diameter(), model.diameter(), part.config.pixels_per_diameter,
           part.config.normal_radius_px, part.config.use_cloud_normals, part.config.threads})
          .image;
  if (std::none_of(image.depth.begin(), image.depth.end(), [](float z) { return z > 0; }))
    throw InputError("no measured point in the region of interest: check --roi");
  std::vector<ListedPose> poses;
  std::vector<Eigen::Isometry3f> transforms;
  for (std::size_t i = 0; i < file.result.poses.size(); ++i)
  {
    const DetectedPose& pose = file.result.poses[i];
    if (!pose.reliable && !options.all) continue;
    transforms.push_back(pose.T_cloud_model.cast<float>());
    poses.push_back({i, &pose, transforms.back()});
  }
  printTable(poses, PoseChecker(image, model, part.config).check(transforms));
  if (!options.image.empty()) writePicture(options.image, image, model, poses);
}
}  // namespace
}  // namespace ppf_bin_picking

int main(int argc, char** argv)
{
  using namespace ppf_bin_picking;
  CLI::App app("Prints what a person would check of each pose, and draws the poses.",
               "check_poses");
  Options options;
  app.add_option("result", options.result, "Result of detect_poses, .json")->required();
  options.part.add(app);
  options.scene.add(app);
  app.add_option("--image", options.image, "Picture to write, .png");
  app.add_flag("--all", options.all, "Unreliable poses, too");
  return runTool(app, argc, argv, [&] { checkPoses(options); });
}

#include "tool_support.hpp"

#include "ppf_bin_picking/io/cloud_io.hpp"
#include "ppf_bin_picking/io/config_io.hpp"
#include "ppf_bin_picking/io/depth_io.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_training.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace ppf_bin_picking
{
namespace
{
constexpr int kBadInput = 2;
constexpr int kDefect = 1;

int failed(const CLI::App& app, const std::string& sentence, int status)
{
  std::cerr << app.get_name() << ": " << sentence << "\n";
  return status;
}

/// What is empty was meant to be something: a shell's variable that is not set, say.
void requireValues(const CLI::App& app)
{
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.empty())
        throw InputError(option->get_name() + " is empty: give a value" +
                         (option->get_required() ? "" : ", or leave it out"));
}
}  // namespace

int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& tool)
{
  try
  {
    app.parse(argc, argv);
    requireValues(app);
    tool();
    return 0;
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    return failed(app, std::string(error.what()) + ": see --help", kBadInput);
  }
  catch (const InputError& error)
  {
    return failed(app, error.what(), kBadInput);
  }
  catch (const std::invalid_argument& error)  // the core's word for input that it cannot use
  {
    return failed(app, error.what(), kBadInput);
  }
  catch (const std::exception& error)
  {
    return failed(app, std::string("internal error: ") + error.what(), kDefect);
  }
}

void requireNoInput(const std::string& output, const std::vector<std::string>& inputs)
{
  for (const std::string& input : inputs)
  {
    std::error_code none;  // of files that do not exist
    if (std::filesystem::equivalent(output, input, none))
      throw InputError(output + " is both an input and the output: give the output another name");
  }
}

CLI::Validator numberWithin(double low, double high)
{
  const auto problem = [low, high](const std::string& text)
  {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
      return std::string();
    return text + " is no number from " + plainDecimal(low) + " to " + plainDecimal(high);
  };
  return {problem, "NUMBER"};
}

void report(const std::string& line)
{
  std::cerr << line << "\n";
}

void PartOptions::add(CLI::App& app)
{
  app.add_option("--part", part, "Part file: mesh, unit, symmetries")->required();
  app.add_option("--config", config, "Settings; what it leaves out has its default");
}

ToolPart PartOptions::load(const std::string& output) const
{
  ToolPart loaded;
  loaded.description = loadPart(part);
  requireNoInput(output, {part, config, loaded.description.mesh_file});
  loaded.config =
      loaded.description.adapted(config.empty() ? DetectorConfig() : loadDetectorConfig(config));
  LoadedMesh mesh = loadMesh(loaded.description.mesh_file, loaded.description.unit);
  for (const std::string& warning : mesh.warnings)
    report("warning: " + warning);
  loaded.mesh_checksum = meshChecksum(mesh.mesh);
  loaded.mesh = std::move(mesh.mesh);
  return loaded;
}

PpfModel trainedModel(const ToolPart& part)
{
  report("training " + part.description.model_id + ": " +
         std::to_string(part.mesh.triangles.size()) + " triangles ...");
  TrainedPart trained = trainPart(part.description, part.mesh, part.config.model);
  const PpfModel& model = trained.model;
  std::ostringstream line;
  line << "trained " << part.description.model_id << ": diameter " << model.diameter() << " m, "
       << model.data().points.size() << " points, " << model.data().entries.size() << " pairs";
  for (const std::string& note : trained.notes)
    report(note);
  for (const std::string& warning : trained.warnings)
    report("warning: " + warning);
  report(line.str());
  return std::move(trained.model);
}

void SceneOptions::add(CLI::App& app)
{
  CLI::Option* cloud_option =
      app.add_option("--cloud", cloud, "Cloud in the camera's optical frame, .pcd or .ply");
  app.add_option("--cloud-unit", cloud_unit, "Unit of the cloud: m (default) or mm")
      ->needs(cloud_option);
  CLI::Option* depth_option =
      app.add_option("--depth", depth, "16-bit depth image, .png")->excludes(cloud_option);
  CLI::Option* camera_option =
      app.add_option("--camera", camera, "Camera of the depth image, .yaml")->needs(depth_option);
  depth_option->needs(camera_option);
  app.add_option("--roi", roi, "Region of interest, .yaml; without it everywhere");
}

Scene SceneOptions::load(std::size_t max_points, const std::string& output) const
{
  requireNoInput(output, {cloud, depth, camera, roi});
  Scene scene;
  if (!roi.empty()) scene.roi = loadRegion(roi);
  if (!depth.empty())
  {
    const DepthCamera depth_camera = loadDepthCamera(camera);
    scene.cloud = loadDepthCloud(depth, depth_camera, max_points);
    scene.frame_id = depth_camera.frame_id;
    scene.camera = depth_camera.pinhole;
    return scene;
  }
  if (cloud.empty()) throw InputError("no scene given: add --cloud, or --depth with --camera");
  LoadedCloud loaded =
      loadCloud(cloud, lengthUnitFromString(cloud_unit, "--cloud-unit"), max_points);
  for (const std::string& warning : loaded.warnings)
    report("warning: " + warning);
  scene.cloud = std::move(loaded.cloud);
  return scene;
}
}  // namespace ppf_bin_picking

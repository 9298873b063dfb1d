/// @file What the command-line tools share: options, scene, messages, exit status.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/point_cloud.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/region_of_interest.hpp"

#include "ppf_bin_picking/io/part_io.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// Parses the arguments and runs a tool. Bad arguments and bad input give one sentence on stderr.
/// @return The exit status: 0 done, 2 bad arguments or input, 1 a defect of ours.
int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& tool);

/// @throw InputError if a file to be written is one of those that are read. Names of files that do
/// not exist, and empty ones, are equal to none.
void requireNoInput(const std::string& output, const std::vector<std::string>& inputs);

/// Allows numbers from low to high, and unlike CLI::Range no NaN.
CLI::Validator numberWithin(double low, double high);

/// One line of progress on stderr.
void report(const std::string& line);

/// A part with its mesh and the settings for it.
struct ToolPart
{
  PartDescription description;
  TriangleMesh mesh;            ///< [m]
  std::uint32_t mesh_checksum;  ///< Of mesh.
  DetectorConfig config;        ///< The file's, with the part's own settings.
};

/// Options --part and --config.
struct PartOptions
{
  void add(CLI::App& app);
  /// Loads part and mesh; warnings go to stderr.
  /// @param output  A file to be written. @throw InputError if it is one of those read here.
  ToolPart load(const std::string& output = {}) const;

  std::string part;
  std::string config;
};

/// Trains a part's model and reports the time.
PpfModel trainedModel(const ToolPart& part);

/// What the camera saw, and where to look.
struct Scene
{
  PointCloud cloud;
  std::string frame_id;  ///< Empty for a cloud file.
  std::optional<RegionOfInterest> roi;
  std::optional<PinholeCamera> camera;  ///< Of a depth image.
};

/// Options --cloud, --cloud-unit, --depth, --camera and --roi.
struct SceneOptions
{
  void add(CLI::App& app);
  /// @param max_points  More are refused.
  /// @param output      A file to be written. @throw InputError if it is one of those read here.
  Scene load(std::size_t max_points, const std::string& output = {}) const;

  std::string cloud;
  std::string cloud_unit = "m";
  std::string depth;
  std::string camera;
  std::string roi;
};
}  // namespace ppf_bin_picking

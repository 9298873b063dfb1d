/// @file record_cell: a simulated bin as a bag that replay.launch plays. No ROS master is needed.
#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"
#include "ppf_bin_picking/sim/depth_sensor.hpp"

#include "cell_messages.hpp"
#include "tool_support.hpp"

#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include <rosbag/bag.h>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::CellParams;
using ppf_bin_picking::CellShot;
using ppf_bin_picking::SimulatedCell;

constexpr int kMaxShots = 1000;
constexpr const char* kPointsTopic = "/camera/depth/points";  // the input of replay.launch
constexpr const char* kTruthTopic = "/simulated_cell/truth";

struct Options
{
  std::string config;
  std::string part;
  std::string preset;
  int count = -1;  ///< -1: as the configuration says.
  int seed = -1;
  int shots = 3;
  std::string output;
};

/// The configuration with what the command line changes.
CellParams paramsOf(const Options& options)
{
  YAML::Node node = options.config.empty() ? YAML::Node(YAML::NodeType::Map)
                                           : ppf_bin_picking::loadYaml(options.config);
  if (options.config.empty() && options.part.empty())
    throw ppf_bin_picking::InputError("no part given: add --part, or --config with a part");
  if (!options.part.empty()) node["part"] = options.part;
  if (options.count >= 0) node["count"] = options.count;
  if (options.seed >= 0) node["seed"] = options.seed;
  if (!options.preset.empty()) node["sensor"]["preset"] = options.preset;
  return ppf_bin_picking::readCellParams(node,
                                         options.config.empty() ? "command line" : options.config);
}

/// Writes a message that the player publishes latched, as tf's static transforms must be.
template <class Message>
void writeLatched(rosbag::Bag& bag, const std::string& topic, ros::Time stamp,
                  const Message& message)
{
  namespace traits = ros::message_traits;
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = traits::datatype<Message>();
  (*header)["md5sum"] = traits::md5sum<Message>();
  (*header)["message_definition"] = traits::definition<Message>();
  (*header)["latching"] = "1";
  (*header)["callerid"] = "/record_cell";
  bag.write(topic, stamp, message, header);
}

/// One pile, a shot a second. Stamps begin at 1 s, so that the same arguments give the same bag.
void record(const Options& options)
{
  ppf_bin_picking::requireWritable(options.output);
  const CellParams params = paramsOf(options);
  ppf_bin_picking::requireNoInput(
      options.output,
      {options.config, params.part, ppf_bin_picking::loadPart(params.part).mesh_file});
  const auto loaded = loadCellPart(params);
  for (const std::string& warning : loaded.warnings)
    ppf_bin_picking::report("warning: " + warning);
  ppf_bin_picking::report("dropping " + std::to_string(params.count) + " parts of " +
                          loaded.model_id + " ...");
  SimulatedCell cell(params.cell, loaded.part, static_cast<std::uint32_t>(params.seed));
  cell.refill(params.count);
  ppf_bin_picking::report(std::to_string(params.count) + " parts of " + loaded.model_id +
                          " have fallen into the bin");

  rosbag::Bag bag(options.output, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::LZ4);
  ros::Time stamp(1.0);
  tf2_msgs::TFMessage frames;
  frames.transforms = frameMessages(cell, params, stamp);
  writeLatched(bag, "/tf_static", stamp, frames);
  writeLatched(bag, kTruthTopic, stamp, truthMessage(cell.parts(), params, stamp));
  for (int index = 0; index < options.shots; ++index, stamp += ros::Duration(1.0))
  {
    const CellShot shot = cell.shot();
    bag.write(kPointsTopic, stamp, cloudMessage(shot.view, params, stamp));
    ppf_bin_picking::report("shot " + std::to_string(index + 1) + " of " +
                            std::to_string(options.shots));
  }
}
}  // namespace
}  // namespace ppf_bin_picking_ros

int main(int argc, char** argv)
{
  CLI::App app("Records shots of a simulated bin as a bag, with tf and truth.", "record_cell");
  ppf_bin_picking_ros::Options options;
  app.add_option("--config", options.config, "Parameters as in config/simulated_cell.yaml");
  app.add_option("--part", options.part, "Part file, .yaml; else the configuration's");
  app.add_option("--count", options.count, "Parts in the bin, instead of the configuration's")
      ->check(CLI::Range(0, ppf_bin_picking::CellParams::kMaxParts));
  app.add_option("--seed", options.seed, "Seed, instead of the configuration's")
      ->check(CLI::Range(0, ppf_bin_picking::CellParams::kMaxSeed));
  app.add_option("--preset", options.preset,
                 "Sensor instead of the configuration's: clean, industrial, low_cost")
      ->check(CLI::IsMember(ppf_bin_picking::sensorPresetNames()));
  app.add_option("--shots", options.shots, "Shots of the same pile, each with its own noise")
      ->check(CLI::Range(1, ppf_bin_picking_ros::kMaxShots));
  app.add_option("--output", options.output, "Bag to write, .bag")->required();
  return ppf_bin_picking::runTool(app, argc, argv, [&] { ppf_bin_picking_ros::record(options); });
}

/// @file Node `simulated_camera`: a depth camera over a simulated bin. config/simulated_camera.yaml
/// explains its parameters.
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/io/yaml_map.hpp"
#include "ppf_bin_picking/ros/params.hpp"
#include "ppf_bin_picking/sim/simulated_cell.hpp"

#include "sensor_params.hpp"

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <string>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::CellSettings;
using ppf_bin_picking::CellShot;
using ppf_bin_picking::InputError;
using ppf_bin_picking::YamlMap;

constexpr int kMaxParts = 500;
constexpr double kMaxRate_hz = 100;

struct CameraParams
{
  std::string part;
  int count = 14;
  int seed = 1;
  double rate_hz = 1.0;
  std::string base_frame = "base_link";
  std::string bin_frame = "bin";
  std::string camera_frame = "camera_optical_frame";
  CellSettings cell;
};

/// Reads numbers that may be left out, and requires that they lie in a range.
class Reader
{
public:
  explicit Reader(const YamlMap& map) : map_(map) {}

  void number(const std::string& key, double low, double high, double& value) const
  {
    if (!map_.has(key)) return;
    value = map_.number(key);
    if (value >= low && value <= high) return;
    throw InputError(map_.where() + ": " + key + " is " + ppf_bin_picking::plainDecimal(value) +
                     ": give a value from " + ppf_bin_picking::plainDecimal(low) + " to " +
                     ppf_bin_picking::plainDecimal(high));
  }
  void integer(const std::string& key, int low, int high, int& value) const
  {
    if (!map_.has(key)) return;
    value = map_.integer(key);
    if (value >= low && value <= high) return;
    throw InputError(map_.where() + ": " + key + " is " + std::to_string(value) +
                     ": give a value from " + std::to_string(low) + " to " + std::to_string(high));
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

/// Where programs of this user keep what they can compute anew.
std::string cacheFolder()
{
  const char* const home = std::getenv("HOME");
  return home == nullptr ? "" : std::string(home) + "/.cache/ppf_bin_picking";
}

/// @throw InputError naming the parameter and the remedy.
CameraParams readParams(const ros::NodeHandle& private_nh)
{
  XmlRpc::XmlRpcValue tree;
  private_nh.getParam("", tree);
  const YamlMap map(toYaml(tree), private_nh.getNamespace(),
                    {"part", "count", "seed", "rate_hz", "base_frame", "bin_frame", "camera_frame",
                     "cache_folder", "bin", "camera", "sensor"});
  CameraParams params;
  params.part = map.text("part");
  const Reader reader(map);
  reader.integer("count", 0, kMaxParts, params.count);
  reader.integer("seed", 0, 1000000, params.seed);
  reader.number("rate_hz", 0.01, kMaxRate_hz, params.rate_hz);
  reader.text("base_frame", params.base_frame);
  reader.text("bin_frame", params.bin_frame);
  reader.text("camera_frame", params.camera_frame);
  params.cell.cache_folder = cacheFolder();
  reader.text("cache_folder", params.cell.cache_folder);
  if (map.has("bin")) readBin(map.map("bin", {"size_m", "wall_m", "position_m"}), params.cell);
  if (map.has("camera")) readCamera(map.map("camera", {"position_m", "target_m"}), params.cell);
  if (map.has("sensor"))
    params.cell.sensor = readDepthSensor(map.map("sensor", ppf_bin_picking::depthSensorKeys()));
  return params;
}

sensor_msgs::PointCloud2 toMessage(const ppf_bin_picking::DepthView& view, const std::string& frame)
{
  const ppf_bin_picking::PointCloud& cloud = view.cloud_camera;
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = frame;
  message.height = static_cast<std::uint32_t>(cloud.height);
  message.width = static_cast<std::uint32_t>(cloud.width);
  constexpr int kFloat = sensor_msgs::PointField::FLOAT32;
  sensor_msgs::PointCloud2Modifier(message).setPointCloud2Fields(
      4, "x", 1, kFloat, "y", 1, kFloat, "z", 1, kFloat, "intensity", 1, kFloat);
  sensor_msgs::PointCloud2Iterator<float> fields(message, "x");
  for (std::size_t pixel = 0; pixel < cloud.size(); ++pixel, ++fields)
  {
    std::copy_n(cloud.points[pixel].data(), 3, &fields[0]);
    fields[3] = view.brightness[pixel];
  }
  return message;
}

geometry_msgs::PoseArray toMessage(const std::vector<ppf_bin_picking::PartTruth>& parts,
                                   const std::string& frame)
{
  geometry_msgs::PoseArray message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time::now();
  for (const auto& part : parts)
    message.poses.push_back(tf2::toMsg(part.T_camera_model));
  return message;
}

geometry_msgs::TransformStamped toMessage(const Eigen::Isometry3d& T_parent_child,
                                          const std::string& parent, const std::string& child)
{
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T_parent_child);
  message.header.frame_id = parent;
  message.header.stamp = ros::Time::now();
  message.child_frame_id = child;
  return message;
}

/// Publishes the same shot again and again, each time with a new stamp, until the node ends.
void publishShots(ros::NodeHandle& private_nh, const CameraParams& params, const CellShot& shot)
{
  const Eigen::Isometry3d T_base_bin(Eigen::Translation3d(params.cell.bin_position_m));
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform({toMessage(shot.T_base_camera, params.base_frame, params.camera_frame),
                             toMessage(T_base_bin, params.base_frame, params.bin_frame)});

  const auto truth = private_nh.advertise<geometry_msgs::PoseArray>("truth", 1, true);
  truth.publish(toMessage(shot.parts, params.camera_frame));

  const auto points = private_nh.advertise<sensor_msgs::PointCloud2>("points", 1);
  sensor_msgs::PointCloud2 cloud = toMessage(shot.view, params.camera_frame);
  for (ros::WallRate rate(params.rate_hz); ros::ok(); rate.sleep())
  {
    cloud.header.stamp = ros::Time::now();
    points.publish(cloud);
    ros::spinOnce();
  }
}

void run(ros::NodeHandle& private_nh)
{
  const CameraParams params = readParams(private_nh);
  const auto part = ppf_bin_picking::loadPart(params.part);
  const auto loaded = ppf_bin_picking::loadMesh(part.mesh_file, part.unit);
  for (const std::string& warning : loaded.warnings)
    ROS_WARN_STREAM(warning);
  const CellShot shot =
      simulateCell(params.cell, loaded.mesh, params.count, static_cast<std::uint32_t>(params.seed));
  const auto half_visible =
      std::count_if(shot.parts.begin(), shot.parts.end(),
                    [](const auto& truth) { return truth.visible_share >= 0.5; });
  ROS_INFO("%d parts of %s in the bin, %d of them at least half visible", params.count,
           part.model_id.c_str(), static_cast<int>(half_visible));
  publishShots(private_nh, params, shot);
}
}  // namespace
}  // namespace ppf_bin_picking_ros

int main(int argc, char** argv)
{
  ros::init(argc, argv, "simulated_camera");
  ros::NodeHandle private_nh("~");  // out here, as the log ends with the last handle
  try
  {
    ppf_bin_picking_ros::run(private_nh);
    return 0;
  }
  catch (const std::exception& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}

#include "cell_messages.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <string>

namespace ppf_bin_picking_ros
{
using ppf_bin_picking::CellParams;

namespace
{
geometry_msgs::TransformStamped transform(const Eigen::Isometry3d& T_parent_child,
                                          const std_msgs::Header& parent, const std::string& child)
{
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T_parent_child);
  message.header = parent;
  message.child_frame_id = child;
  return message;
}
}  // namespace

sensor_msgs::PointCloud2 cloudMessage(const ppf_bin_picking::DepthView& view,
                                      const CellParams& params, ros::Time stamp)
{
  const ppf_bin_picking::PointCloud& cloud = view.cloud_camera;
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = params.camera_frame;
  message.header.stamp = stamp;
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

geometry_msgs::PoseArray truthMessage(const std::vector<Eigen::Isometry3d>& T_base_parts,
                                      const CellParams& params, ros::Time stamp)
{
  geometry_msgs::PoseArray message;
  message.header.frame_id = params.base_frame;
  message.header.stamp = stamp;
  for (const Eigen::Isometry3d& T_base_part : T_base_parts)
    message.poses.push_back(tf2::toMsg(T_base_part));
  return message;
}

std::vector<geometry_msgs::TransformStamped> frameMessages(
    const ppf_bin_picking::SimulatedCell& cell, const CellParams& params, ros::Time stamp)
{
  std_msgs::Header base;
  base.frame_id = params.base_frame;
  base.stamp = stamp;
  return {transform(cell.T_base_camera(), base, params.camera_frame),
          transform(cell.T_base_bin(), base, params.bin_frame)};
}
}  // namespace ppf_bin_picking_ros

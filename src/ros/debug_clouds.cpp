#include "ppf_bin_picking/ros/debug_clouds.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <array>
#include <cmath>

namespace ppf_bin_picking_ros
{
namespace
{
using Color = std::array<std::uint8_t, 3>;

constexpr Color kNoiseColor = {140, 140, 140};
constexpr Color kSceneColor = {200, 200, 200};

/// Neighbouring numbers get hues far apart: each is a golden section of the circle further.
Color clusterColor(const std::int32_t cluster)
{
  if (cluster < 0) return kNoiseColor;
  const double hue = std::fmod(cluster * 0.618033988749895, 1.0) * 2.0 * M_PI;
  Color color;
  for (std::size_t i = 0; i < 3; ++i)
    color[i] = static_cast<std::uint8_t>(
        155.0 + 100.0 * std::cos(hue - 2.0 * M_PI * static_cast<double>(i) / 3.0));
  return color;
}

/// @param pointOf  Index to point in the target frame.
/// @param colorOf  Index to colour.
template <class PointOf, class ColorOf>
sensor_msgs::PointCloud2 coloredCloud(const std_msgs::Header& header, const std::size_t size,
                                      const PointOf& pointOf, const ColorOf& colorOf)
{
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(size);
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> blue(cloud, "rgb");  // bytes b g r
  for (std::size_t i = 0; i < size; ++i, ++x, ++blue)
  {
    const Eigen::Vector3f point = pointOf(i);
    const Color color = colorOf(i);
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = point[axis];
    for (int channel = 0; channel < 3; ++channel)
      blue[channel] = color[2 - channel];
  }
  return cloud;
}
}  // namespace

sensor_msgs::PointCloud2 distributionCloud(const DetectionView& view)
{
  const auto& hypotheses = view.result.distribution;
  const Eigen::Isometry3f T_target_cloud = view.T_target_cloud.cast<float>();
  return coloredCloud(
      view.header, hypotheses.size(),
      [&](const std::size_t i) -> Eigen::Vector3f { return T_target_cloud * hypotheses[i].center; },
      [&](const std::size_t i) { return clusterColor(hypotheses[i].cluster); });
}

sensor_msgs::PointCloud2 orientationCloud(const DetectionView& view)
{
  const auto& hypotheses = view.result.distribution;
  const Eigen::Quaternionf q_target_cloud(view.T_target_cloud.cast<float>().linear());
  const auto ballPoint = [&](const std::size_t i) -> Eigen::Vector3f
  {
    const Eigen::AngleAxisf turn(q_target_cloud * hypotheses[i].rotation);
    return turn.axis() * (turn.angle() / static_cast<float>(M_PI));
  };
  return coloredCloud(view.header, hypotheses.size(), ballPoint,
                      [&](const std::size_t i) { return clusterColor(hypotheses[i].cluster); });
}

sensor_msgs::PointCloud2 sceneCloud(const DetectionView& view)
{
  const auto& points = view.result.scene_points;
  const Eigen::Isometry3f T_target_cloud = view.T_target_cloud.cast<float>();
  return coloredCloud(
      view.header, points.size(),
      [&](const std::size_t i) -> Eigen::Vector3f { return T_target_cloud * points[i]; },
      [](std::size_t) { return kSceneColor; });
}
}  // namespace ppf_bin_picking_ros

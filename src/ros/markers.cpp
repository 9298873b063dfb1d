#include "ppf_bin_picking/ros/markers.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ppf_bin_picking_ros
{
namespace
{
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr std::array<float, 4> kGreen = {0.10F, 0.80F, 0.20F, 1.0F};
constexpr std::array<float, 4> kRed = {0.95F, 0.10F, 0.10F, 1.0F};
constexpr std::array<float, 4> kClearRed = {0.95F, 0.10F, 0.10F, 0.35F};
constexpr std::array<float, 4> kBlue = {0.30F, 0.60F, 1.0F, 0.9F};
constexpr std::array<float, 4> kGrey = {0.6F, 0.6F, 0.6F, 0.8F};
constexpr std::array<float, 4> kYellow = {1.0F, 0.85F, 0.20F, 1.0F};

constexpr double kLineWidth_m = 0.0006;
constexpr double kCrossArm_m = 0.0015;
constexpr double kThinnestBox_m = 0.0005;  // rviz refuses a box without thickness
constexpr std::size_t kMaxNoiseCrosses = 5000;
constexpr std::size_t kMaxRegions = 100;

/// Builds the array: numbers the markers and gives each its header.
class Drawing
{
public:
  explicit Drawing(const std_msgs::Header& header) : header_(header)
  {
    add("", Marker::CUBE, kGrey, Eigen::Isometry3d::Identity()).action = Marker::DELETEALL;
  }

  Marker& add(const std::string& name, const int type, const std::array<float, 4>& color,
              const Eigen::Isometry3d& T_target_marker)
  {
    Marker marker;
    marker.header = header_;
    marker.ns = name;
    marker.id = static_cast<int>(array_.markers.size());
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose = tf2::toMsg(T_target_marker);
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    std::tie(marker.color.r, marker.color.g, marker.color.b, marker.color.a) =
        std::tie(color[0], color[1], color[2], color[3]);
    array_.markers.push_back(std::move(marker));
    return array_.markers.back();
  }

  MarkerArray take() { return std::move(array_); }

private:
  std_msgs::Header header_;
  MarkerArray array_;
};

geometry_msgs::Point toPoint(const Eigen::Vector3d& point)
{
  return tf2::toMsg(point);
}

void addMesh(Drawing& drawing, const std::string& name, const std::array<float, 4>& color,
             const Eigen::Isometry3d& T_target_model, const PartView& part)
{
  const ppf_bin_picking::TriangleMesh& mesh = part.mesh_to_draw;
  Marker& marker = drawing.add(name, Marker::TRIANGLE_LIST, color, T_target_model);
  marker.points.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      marker.points.push_back(toPoint(mesh.vertices[vertex].cast<double>()));
}

/// The twelve edges of a box that is axis-aligned in the marker's frame.
void addEdges(Marker& marker, const Eigen::Vector3d& min, const Eigen::Vector3d& max)
{
  marker.scale.x = kLineWidth_m;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner)
    {
      Eigen::Vector3d from = min;
      if (corner & 1) from[(axis + 1) % 3] = max[(axis + 1) % 3];
      if (corner & 2) from[(axis + 2) % 3] = max[(axis + 2) % 3];
      Eigen::Vector3d to = from;
      to[axis] = max[axis];
      marker.points.push_back(toPoint(from));
      marker.points.push_back(toPoint(to));
    }
}

void addPickable(Drawing& drawing, const DetectionView& view)
{
  for (const ppf_bin_picking::DetectedPose& pose : view.result.poses)
    if (pose.reliable)
      addMesh(drawing, "pickable", kGreen, view.T_target_cloud * pose.T_cloud_model,
              *view.parts.at(pose.model));
}

void addRegions(Drawing& drawing, const DetectionView& view)
{
  const auto& regions = view.result.regions;
  for (std::size_t i = 0; i < std::min(regions.size(), kMaxRegions); ++i)
  {
    const Eigen::Vector3d size = regions[i].box.size.cwiseMax(kThinnestBox_m);
    Marker& box = drawing.add("mismatching_regions", Marker::CUBE, kClearRed,
                              view.T_target_cloud * regions[i].box.T_cloud_box);
    tf2::toMsg(size, box.scale);
    addMesh(drawing, "mismatching_poses", kRed, view.T_target_cloud * regions[i].T_cloud_best,
            *view.parts.at(regions[i].model));
  }
}

void addClusters(Drawing& drawing, const DetectionView& view)
{
  for (const ppf_bin_picking::HypothesisCluster& cluster : view.result.clusters)
    addEdges(drawing.add("clusters", Marker::LINE_LIST, kBlue,
                         view.T_target_cloud * cluster.box.T_cloud_box),
             -0.5 * cluster.box.size, 0.5 * cluster.box.size);
}

void addNoise(Drawing& drawing, const DetectionView& view)
{
  std::vector<geometry_msgs::Point> ends;
  for (const ppf_bin_picking::PoseHypothesis& hypothesis : view.result.distribution)
  {
    if (hypothesis.cluster >= 0) continue;
    if (ends.size() >= 6 * kMaxNoiseCrosses) break;
    const Eigen::Vector3d center = hypothesis.center.cast<double>();
    for (int axis = 0; axis < 3; ++axis)
      for (const double arm : {-kCrossArm_m, kCrossArm_m})
        ends.push_back(toPoint(center + arm * Eigen::Vector3d::Unit(axis)));
  }
  if (ends.empty()) return;
  Marker& marker = drawing.add("noise", Marker::LINE_LIST, kGrey, view.T_target_cloud);
  marker.scale.x = 0.5 * kLineWidth_m;
  marker.points = std::move(ends);
}
}  // namespace

MarkerArray toMarkers(const DetectionView& view)
{
  Drawing drawing(view.header);
  if (view.roi)
    addEdges(
        drawing.add("roi", Marker::LINE_LIST, kYellow, view.T_target_cloud * view.roi->T_cloud_box),
        view.roi->min, view.roi->max);
  addPickable(drawing, view);
  addRegions(drawing, view);
  addClusters(drawing, view);
  addNoise(drawing, view);
  return drawing.take();
}

MarkerArray noMarkers(const std_msgs::Header& header)
{
  return Drawing(header).take();
}
}  // namespace ppf_bin_picking_ros

#include "ppf_bin_picking/ros/result_publisher.hpp"

#include "ppf_bin_picking/ros/debug_clouds.hpp"
#include "ppf_bin_picking/ros/markers.hpp"

namespace ppf_bin_picking_ros
{
namespace
{
constexpr std::uint32_t kQueueSize = 5;
constexpr bool kLatched = true;

msg::Detection toDetection(const Response& response)
{
  msg::Detection detection;
  detection.header = response.header;
  detection.status = response.status;
  detection.message = response.message;
  detection.poses = response.poses;
  return detection;
}

template <class MakeMessage>
void publishIfHeard(const ros::Publisher& publisher, const MakeMessage& makeMessage)
{
  if (publisher.getNumSubscribers() > 0) publisher.publish(makeMessage());
}
}  // namespace

ResultPublisher::ResultPublisher(ros::NodeHandle private_nh)
    : markers_(private_nh.advertise<visualization_msgs::MarkerArray>("markers", 1, kLatched)),
      poses_(private_nh.advertise<geometry_msgs::PoseArray>("poses", kQueueSize)),
      detection_(private_nh.advertise<msg::Detection>("detection", kQueueSize)),
      distribution_(private_nh.advertise<sensor_msgs::PointCloud2>("pose_distribution", 1)),
      orientation_(
          private_nh.advertise<sensor_msgs::PointCloud2>("pose_distribution_orientation", 1)),
      scene_(private_nh.advertise<sensor_msgs::PointCloud2>("scene", 1))
{
}

void ResultPublisher::publish(const DetectionView& view, const Response& response)
{
  msg::Detection detection = toDetection(response);
  detection.mismatching_regions = mismatchRegions(view);
  for (const ppf_bin_picking::StageTime& stage : view.result.stages)
  {
    detection.stage_names.push_back(stage.name);
    detection.stage_seconds.push_back(stage.seconds);
  }
  detection_.publish(detection);
  markers_.publish(toMarkers(view));
  drawn_frame_ = view.header.frame_id;
  poses_.publish(toPoseArray(view));
  publishIfHeard(distribution_, [&] { return distributionCloud(view); });
  publishIfHeard(orientation_, [&] { return orientationCloud(view); });
  publishIfHeard(scene_, [&] { return sceneCloud(view); });
}

void ResultPublisher::publishFailure(const Response& response)
{
  detection_.publish(toDetection(response));
  if (drawn_frame_.empty()) return;
  std_msgs::Header header;  // of a frame that rviz knows, at the latest transform
  header.frame_id = drawn_frame_;
  markers_.publish(noMarkers(header));
  geometry_msgs::PoseArray no_poses;
  no_poses.header = header;
  poses_.publish(no_poses);
  drawn_frame_.clear();
}
}  // namespace ppf_bin_picking_ros

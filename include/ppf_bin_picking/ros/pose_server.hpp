/// @file The node's server: clouds in, answers out.
#pragma once

#include "ppf_bin_picking/ros/clock_watch.hpp"
#include "ppf_bin_picking/ros/cloud_keeper.hpp"
#include "ppf_bin_picking/ros/part_store.hpp"
#include "ppf_bin_picking/ros/result_publisher.hpp"

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

namespace ppf_bin_picking_ros
{
/// Answers get_pickable_poses. Owns all state of the node. Clouds arrive on the queue of the node
/// handle; requests are served by threads of its own, so that a long detection or a wait for the
/// next cloud holds up neither the clouds nor other nodelets. One request is worked on at a time.
class PoseServer
{
public:
  /// Reads the parameters, starts loading the parts and serves.
  /// @param nh          Handle of the node, for diagnostics and tf.
  /// @param private_nh  Handle of its private names; its name begins the messages.
  /// @throw ParamError  if a parameter is wrong; nothing runs then.
  PoseServer(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

  /// Ends waits and the search under way, waits for the part being loaded, and joins all threads.
  ~PoseServer();

  PoseServer(const PoseServer&) = delete;
  PoseServer& operator=(const PoseServer&) = delete;

private:
  struct Outcome
  {
    std::int16_t status = 0;
    std::string message;  ///< Empty: no request yet.
  };

  void setUpDiagnostics();
  void advertiseService();
  void onCloud(const sensor_msgs::PointCloud2ConstPtr& cloud);
  bool onRequest(const Request& request, Response& response);
  void checkClock();

  void answer(const Request& request, Response& response);
  void detectAndFill(const Request& request, Response& response);
  void fail(Response& response, std::int16_t status, const std::string& message);
  sensor_msgs::PointCloud2ConstPtr acquire(const Request& request) const;
  sensor_msgs::PointCloud2ConstPtr nextCloud(const Request& request) const;
  DetectionView detect(const sensor_msgs::PointCloud2& cloud, const std_msgs::Header& header,
                       const std::vector<LoadedPartPtr>& parts) const;

  void reportInput(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportParts(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportLastRequest(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle private_nh_;
  const ServerParams params_;
  std::atomic<bool> stop_{false};
  ClockWatch clock_;
  CloudKeeper clouds_;
  std::mutex request_mutex_;  ///< Held by the request that is worked on.
  mutable std::mutex outcome_mutex_;
  Outcome last_outcome_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ResultPublisher publisher_;
  diagnostic_updater::Updater diagnostics_;
  PartStore parts_;
  ros::Subscriber cloud_subscriber_;
  ros::WallTimer timer_;
  ros::CallbackQueue service_queue_;
  ros::ServiceServer service_;
  ros::AsyncSpinner service_threads_;  ///< Last: the threads start when all else is there.
};
}  // namespace ppf_bin_picking_ros

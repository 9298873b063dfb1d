/// @file Node `simulated_cell`: a bin of parts under a depth camera, from which parts are picked.
/// config/simulated_cell.yaml explains its parameters, docs/interface.md its services and topics.
#include "ppf_bin_picking/ros/params.hpp"

#include "cell_messages.hpp"

#include <ppf_bin_picking/PickPart.h>
#include <ppf_bin_picking/RefillBin.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::CellParams;
using ppf_bin_picking::LoadedCellPart;
using ppf_bin_picking::PickOutcome;
using ppf_bin_picking::PickPart;
using ppf_bin_picking::PickVerdict;
using ppf_bin_picking::RefillBin;

/// A request that nothing can be done for.
class BadRequest : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @throw BadRequest if a number is not finite or the quaternion no rotation.
Eigen::Isometry3d toIsometry(const geometry_msgs::Pose& pose)
{
  const auto& q = pose.orientation;
  const Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
  const Eigen::Vector3d place(pose.position.x, pose.position.y, pose.position.z);
  if (!place.allFinite() || !(std::abs(turn.norm() - 1) < 0.01))
    throw BadRequest("the pose is none: give finite numbers and a quaternion of length 1");
  return Eigen::Translation3d(place) * turn.normalized();
}

std::int16_t statusOf(PickOutcome outcome)
{
  switch (outcome)
  {
    case PickOutcome::kTaken:
      return PickPart::Response::OK;
    case PickOutcome::kNoPartThere:
      return PickPart::Response::NO_PART_THERE;
    case PickOutcome::kCovered:
      return PickPart::Response::COVERED;
  }
  throw std::logic_error("an outcome of a pick has no status");
}

/// Owns the cell. All its callbacks run in one thread, one after the other.
class CellNode
{
public:
  CellNode(ros::NodeHandle& private_nh, CellParams params, const LoadedCellPart& loaded)
      : params_(std::move(params)),
        model_id_(loaded.model_id),
        cell_(params_.cell, loaded.part, static_cast<std::uint32_t>(params_.seed)),
        listener_(frames_)
  {
    cell_.refill(params_.count);
    const auto frames = frameMessages(cell_, params_, ros::Time::now());
    for (const geometry_msgs::TransformStamped& frame : frames)
      frames_.setTransform(frame, "simulated_cell", true);
    broadcaster_.sendTransform(frames);
    points_ = private_nh.advertise<sensor_msgs::PointCloud2>("points", 1, true);
    truth_ = private_nh.advertise<geometry_msgs::PoseArray>("truth", 1, true);
    showChange();
    services_ = {private_nh.advertiseService("trigger", &CellNode::trigger, this),
                 private_nh.advertiseService("pick", &CellNode::pick, this),
                 private_nh.advertiseService("refill", &CellNode::refill, this)};
    if (params_.rate_hz > 0)
      timer_ = private_nh.createWallTimer(ros::WallDuration(1 / params_.rate_hz),
                                          [this](const ros::WallTimerEvent&) { shoot(); });
  }

private:
  /// Publishes a new shot. Returns what it shows, in a few words.
  std::string shoot()
  {
    const ppf_bin_picking::DepthView view = cell_.shot().view;
    points_.publish(cloudMessage(view, params_, ros::Time::now()));
    const auto measured =
        std::count_if(view.cloud_camera.points.begin(), view.cloud_camera.points.end(),
                      [](const Eigen::Vector3f& point) { return std::isfinite(point.z()); });
    return std::to_string(measured) + " of " + std::to_string(view.cloud_camera.size()) +
           " pixels measured, " + partsLeft() + " in the bin";
  }

  /// The pile is another one: publishes its truth and a shot of it.
  void showChange()
  {
    truth_.publish(truthMessage(cell_.parts(), params_, ros::Time::now()));
    shoot();
  }

  std::string partsLeft() const
  {
    const std::size_t count = cell_.parts().size();
    return std::to_string(count) + (count == 1 ? " part" : " parts");
  }

  /// @throw BadRequest naming the frame and tf's own reason.
  Eigen::Isometry3d toBase(const geometry_msgs::PoseStamped& pose) const
  {
    try
    {
      const auto found =
          frames_.lookupTransform(params_.base_frame, pose.header.frame_id, ros::Time());
      return tf2::transformToEigen(found) * toIsometry(pose.pose);
    }
    catch (const tf2::TransformException& error)
    {
      throw BadRequest("the pose's frame '" + pose.header.frame_id + "' is unknown (" +
                       error.what() + "): give one that tf connects with '" + params_.base_frame +
                       "'");
    }
  }

  bool trigger(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response)
  {
    response.message = shoot();
    response.success = 1;
    return true;
  }

  bool pick(PickPart::Request& request, PickPart::Response& response)
  {
    response.error_m = -1;
    try
    {
      if (!request.model_id.empty() && request.model_id != model_id_)
        throw BadRequest("there is no part '" + request.model_id + "' in the cell, which holds '" +
                         model_id_ + "'");
      const PickVerdict verdict = cell_.pick(toBase(request.pose));
      response.status = statusOf(verdict.outcome);
      response.message = verdict.message;
      if (std::isfinite(verdict.error_m)) response.error_m = verdict.error_m;
    }
    catch (const BadRequest& error)
    {
      response.status = PickPart::Response::BAD_REQUEST;
      response.message = error.what();
    }
    catch (const std::exception& error)
    {
      ROS_ERROR_STREAM("pick: " << error.what());
      response.status = PickPart::Response::INTERNAL_ERROR;
      response.message = error.what();
    }
    response.success = response.status == PickPart::Response::OK ? 1 : 0;
    response.parts_left = static_cast<std::uint32_t>(cell_.parts().size());
    if (response.status == PickPart::Response::OK) showChange();
    return true;
  }

  bool refill(RefillBin::Request& request, RefillBin::Response& response)
  {
    try
    {
      const std::size_t count =
          request.count == 0 ? static_cast<std::size_t>(params_.count) : request.count;
      if (cell_.parts().size() + count > CellParams::kMaxParts)
        throw BadRequest("the bin would hold more than " + std::to_string(CellParams::kMaxParts) +
                         " parts: give a smaller count");
      cell_.refill(static_cast<int>(count));
      response.success = 1;
      response.message = std::to_string(count) + " dropped, " + partsLeft() + " in the bin";
    }
    catch (const std::exception& error)
    {
      response.message = error.what();
    }
    response.parts_left = static_cast<std::uint32_t>(cell_.parts().size());
    showChange();
    return true;
  }

  const CellParams params_;
  const std::string model_id_;
  ppf_bin_picking::SimulatedCell cell_;
  tf2_ros::Buffer frames_;
  tf2_ros::TransformListener listener_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher points_;
  ros::Publisher truth_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
};

void run(ros::NodeHandle& private_nh)
{
  XmlRpc::XmlRpcValue tree;
  private_nh.getParam("", tree);
  const CellParams params =
      ppf_bin_picking::readCellParams(toYaml(tree), private_nh.getNamespace());
  const LoadedCellPart loaded = ppf_bin_picking::loadCellPart(params);
  for (const std::string& warning : loaded.warnings)
    ROS_WARN_STREAM(warning);
  const CellNode node(private_nh, params, loaded);
  ROS_INFO("%d parts of %s have fallen into the bin", params.count, loaded.model_id.c_str());
  ros::spin();
}
}  // namespace
}  // namespace ppf_bin_picking_ros

int main(int argc, char** argv)
{
  ros::init(argc, argv, "simulated_cell");
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

#include "ppf_bin_picking/ros/pose_server.hpp"

#include "ppf_bin_picking/core/detection_message.hpp"

#include "ppf_bin_picking/ros/conversions.hpp"
#include "ppf_bin_picking/ros/frame_lookup.hpp"
#include "ppf_bin_picking/ros/request_failed.hpp"
#include "ppf_bin_picking/ros/request_steps.hpp"

#include <algorithm>
#include <initializer_list>
#include <sstream>

namespace ppf_bin_picking_ros
{
namespace
{
constexpr std::uint32_t kServiceThreads = 2;  // one works, one answers BUSY
constexpr std::uint32_t kCloudQueue = 1;

ServerParams paramsOf(const ros::NodeHandle& private_nh)
{
  XmlRpc::XmlRpcValue tree;
  ros::param::get(private_nh.getNamespace(), tree);
  return readServerParams(tree, private_nh.getNamespace());
}

/// Says of an answer that it does not hold all reliable poses, where max_poses leaves some out.
void appendLeftOut(std::string& message, const std::size_t reliable, const std::size_t answered)
{
  if (answered < reliable)
    message += " (max_poses: only the first " + std::to_string(answered) + " returned)";
}

void appendFailures(std::string& message, const std::vector<std::string>& failures)
{
  for (const std::string& failure : failures)
    message += " (not loaded: " + failure + ")";
}

std::string firstNonEmpty(std::initializer_list<std::string> words)
{
  const auto found = std::find_if(words.begin(), words.end(),
                                  [](const std::string& word) { return !word.empty(); });
  return found == words.end() ? std::string() : *found;
}

ros::Duration sinceStart(const SteadyClock::time_point start)
{
  return ros::Duration(std::chrono::duration<double>(SteadyClock::now() - start).count());
}
}  // namespace

PoseServer::PoseServer(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : private_nh_(private_nh),
      params_(paramsOf(private_nh)),
      tf_listener_(tf_buffer_, nh),
      publisher_(private_nh),
      diagnostics_(nh, private_nh, private_nh.getNamespace()),
      parts_(params_),
      service_threads_(kServiceThreads, &service_queue_)
{
  cloud_subscriber_ = private_nh_.subscribe("input", kCloudQueue, &PoseServer::onCloud, this);
  if (!params_.region_of_interest)
    ROS_WARN_STREAM(private_nh_.getNamespace()
                    << ": no region_of_interest is given, so that the bin's walls and all around "
                       "it are searched, too: give the inside of the bin");
  setUpDiagnostics();
  advertiseService();
  service_threads_.start();
}

PoseServer::~PoseServer()
{
  stop_ = true;
  clouds_.stop();
  timer_.stop();
  cloud_subscriber_.shutdown();
  service_.shutdown();
  service_threads_.stop();
}

void PoseServer::advertiseService()
{
  auto options = ros::AdvertiseServiceOptions::create<msg::GetPickablePoses>(
      "get_pickable_poses",
      [this](const Request& request, Response& response) { return onRequest(request, response); },
      ros::VoidConstPtr(), &service_queue_);
  service_ = private_nh_.advertiseService(options);
}

void PoseServer::onCloud(const sensor_msgs::PointCloud2ConstPtr& cloud)
{
  checkClock();  // before, so that the first cloud after a jump is kept
  clouds_.keep(cloud);
}

void PoseServer::checkClock()
{
  if (!clock_.jumpedBack([] { return ros::Time::now(); })) return;
  ROS_WARN_STREAM(private_nh_.getNamespace()
                  << ": the clock jumped back, the kept cloud and all transforms are dropped");
  clouds_.drop();
  tf_buffer_.clear();
}

bool PoseServer::onRequest(const Request& request, Response& response)
{
  const std::unique_lock<std::mutex> lock(request_mutex_, std::try_to_lock);
  if (!lock)
  {
    response.status = Response::BUSY;
    response.message = "Another request is being answered: call again after its answer";
    return true;
  }
  answer(request, response);
  const std::string outcome = private_nh_.getNamespace() + ": status " +
                              std::to_string(response.status) + ": " + response.message;
  if (response.status < Response::OK)
    ROS_WARN_STREAM(outcome);
  else
    ROS_INFO_STREAM(outcome);
  const std::lock_guard<std::mutex> outcome_lock(outcome_mutex_);
  last_outcome_ = {response.status, response.message};
  return true;
}

void PoseServer::answer(const Request& request, Response& response)
{
  try
  {
    checkClock();
    detectAndFill(request, response);
  }
  catch (const RequestFailed& failure)
  {
    fail(response, failure.status(), failure.what());
  }
  catch (const std::exception& error)
  {
    ROS_ERROR_STREAM(private_nh_.getNamespace() << ": a request failed: " << error.what());
    fail(response, Response::INTERNAL_ERROR,
         std::string("A defect of the node ended the request (") + error.what() +
             "): look into its log and report it");
  }
}

void PoseServer::fail(Response& response, const std::int16_t status, const std::string& message)
{
  std_msgs::Header header = response.header;
  response = Response();
  response.header = header;
  response.status = status;
  response.message = message;
  appendFailures(response.message, parts_.failures());
  publisher_.publishFailure(response);
}

void PoseServer::detectAndFill(const Request& request, Response& response)
{
  checkRequest(request);
  const std::vector<LoadedPartPtr> parts = parts_.select(request.model_id);
  const sensor_msgs::PointCloud2ConstPtr cloud = acquire(request);
  const SteadyClock::time_point start = SteadyClock::now();
  response.header.stamp = cloud->header.stamp;
  response.header.frame_id =
      firstNonEmpty({request.target_frame, params_.output_frame, cloud->header.frame_id});
  const DetectionView view = detect(*cloud, response.header, parts);
  const std::size_t max_poses =
      request.max_poses > 0 ? request.max_poses : static_cast<std::size_t>(params_.max_poses);
  response.status = toStatus(view.result.status);
  response.poses = pickablePoses(view, max_poses);
  response.message = view.result.message;
  appendLeftOut(response.message, reliablePoses(view.result), response.poses.size());
  appendFailures(response.message, parts_.failures());
  if (request.include_mismatching) response.mismatching_regions = mismatchRegions(view);
  response.roi_points = static_cast<std::uint32_t>(view.result.roi_points);
  response.cloud_age = limitedDifference(ros::Time::now(), cloud->header.stamp);
  response.processing_time = sinceStart(start);
  publisher_.publish(view, response);
}

sensor_msgs::PointCloud2ConstPtr PoseServer::acquire(const Request& request) const
{
  if (request.acquisition == Request::NEXT) return nextCloud(request);
  const sensor_msgs::PointCloud2ConstPtr cloud = clouds_.newest();
  if (!cloud)
    throw RequestFailed(Response::NO_CLOUD, "No cloud has come on " + cloud_subscriber_.getTopic() +
                                                " yet: check the camera and the name of the topic");
  checkAge(request, cloud->header.stamp, ros::Time::now());
  return cloud;
}

sensor_msgs::PointCloud2ConstPtr PoseServer::nextCloud(const Request& request) const
{
  const double timeout_s = request.timeout.isZero() ? params_.timeout_s : request.timeout.toSec();
  const std::uint64_t received_before = clouds_.received();
  const sensor_msgs::PointCloud2ConstPtr cloud =
      clouds_.waitForNext(ros::Time::now(), steadyDeadline(timeout_s));
  if (cloud)
  {
    checkNotAhead(cloud->header.stamp, ros::Time::now());
    return cloud;
  }
  const std::uint64_t older = clouds_.received() - received_before;
  std::ostringstream text;
  text << "No cloud stamped after the call came on " << cloud_subscriber_.getTopic() << " within "
       << timeout_s << " s, ";
  if (older > 0)
    text << "but " << older << " with an older stamp: check the clock of the camera's driver";
  else
    text << "nor any other: check the camera";
  throw RequestFailed(Response::NO_CLOUD, text.str());
}

DetectionView PoseServer::detect(const sensor_msgs::PointCloud2& cloud,
                                 const std_msgs::Header& header,
                                 const std::vector<LoadedPartPtr>& parts) const
{
  const ppf_bin_picking::PointCloud points = readCloud(cloud, parts);
  const SteadyClock::time_point deadline = steadyDeadline(params_.tf_timeout_s);
  const auto T_frame_cloud = [&](const std::string& frame)
  {
    return waitForTransform(tf_buffer_, {frame, cloud.header.frame_id, header.stamp}, deadline,
                            stop_);
  };
  DetectionView view;
  view.header = header;
  view.T_target_cloud = T_frame_cloud(header.frame_id);
  if (params_.region_of_interest)
  {
    view.roi = params_.region_of_interest->region;
    const std::string& frame = params_.region_of_interest->frame;
    if (!frame.empty())
      view.roi->T_cloud_box = T_frame_cloud(frame).inverse() * view.roi->T_cloud_box;
  }
  for (const LoadedPartPtr& part : parts)
    view.parts.push_back(std::shared_ptr<const PartView>(part, &part->view));
  view.result = detectParts(points, parts, view.roi, stop_);
  return view;
}
}  // namespace ppf_bin_picking_ros

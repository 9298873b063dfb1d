// The part of PoseServer that tells /diagnostics about its input, its parts and its last request.
#include "ppf_bin_picking/ros/pose_server.hpp"

#include <algorithm>
#include <initializer_list>
#include <iomanip>
#include <sstream>

namespace ppf_bin_picking_ros
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

/// An empty bin is not a fault; what keeps the node from looking into it is.
std::uint8_t levelOf(const std::int16_t status)
{
  if (status == Response::INTERNAL_ERROR) return DiagnosticStatus::ERROR;
  const std::initializer_list<std::int16_t> hindered = {Response::NO_CLOUD, Response::CLOUD_TOO_OLD,
                                                        Response::TF_FAILED, Response::BAD_CLOUD};
  const bool is_hindered = std::find(hindered.begin(), hindered.end(), status) != hindered.end();
  return is_hindered ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
}

std::string lastCloudCame(const double age_s)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "The last cloud came " << age_s << " s ago";
  return text.str();
}
}  // namespace

void PoseServer::setUpDiagnostics()
{
  diagnostics_.setHardwareID("none");
  diagnostics_.add("input", this, &PoseServer::reportInput);
  diagnostics_.add("parts", this, &PoseServer::reportParts);
  diagnostics_.add("last request", this, &PoseServer::reportLastRequest);
  // Of the steady clock: the updater's own period stands still with the ROS clock.
  const auto report = [this](const ros::WallTimerEvent&)
  {
    checkClock();
    diagnostics_.force_update();
  };
  timer_ = private_nh_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()), report);
}

/// A triggered camera has no rate, so that the age alone is no fault.
void PoseServer::reportInput(DiagnosticStatusWrapper& status)
{
  const std::optional<double> age_s = clouds_.secondsSinceLast();
  if (cloud_subscriber_.getNumPublishers() == 0)
    status.summary(DiagnosticStatus::WARN, "Nobody publishes " + cloud_subscriber_.getTopic());
  else
    status.summary(DiagnosticStatus::OK, age_s ? lastCloudCame(*age_s) : "No cloud yet");
  status.add("clouds received", clouds_.received());
  if (age_s) status.add("seconds since the last cloud", *age_s);
}

void PoseServer::reportParts(DiagnosticStatusWrapper& status)
{
  const std::vector<std::string> failures = parts_.failures();
  const std::vector<std::string> ids = parts_.loadedIds();
  if (!failures.empty())
    status.summary(DiagnosticStatus::ERROR, failures.front());
  else if (!parts_.finished())
    status.summary(DiagnosticStatus::OK, "Loading parts");
  else
    status.summary(DiagnosticStatus::OK, "All parts are loaded");
  for (const std::string& id : ids)
    status.add(id, "loaded");
  for (const std::string& failure : failures)
    status.add("not loaded", failure);
}

void PoseServer::reportLastRequest(DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(outcome_mutex_);
  if (last_outcome_.message.empty())
  {
    status.summary(DiagnosticStatus::OK, "No request yet");
    return;
  }
  status.summary(levelOf(last_outcome_.status), last_outcome_.message);
  status.add("status", static_cast<int>(last_outcome_.status));
}
}  // namespace ppf_bin_picking_ros

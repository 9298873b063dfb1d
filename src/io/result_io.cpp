#include "ppf_bin_picking/io/result_io.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/rigid_pose.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
using nlohmann::json;
constexpr std::size_t kMaxResultBytes = std::size_t{1} << 28;
constexpr double kMilliseconds = 1000.0;
constexpr std::array<DetectionStatus, 5> kStatuses = {
    DetectionStatus::kOk, DetectionStatus::kNoPickablePose, DetectionStatus::kRoiEmpty,
    DetectionStatus::kTimeLimit, DetectionStatus::kBadCloud};
constexpr std::array<UnreliableReason, 6> kReasons = {
    UnreliableReason::kSpread,  UnreliableReason::kSlippage, UnreliableReason::kLowScore,
    UnreliableReason::kOverlap, UnreliableReason::kRunnerUp, UnreliableReason::kNone};

/// The value whose toString() is a word.
template <class Values>
typename Values::value_type fromWord(const Values& values, const std::string& word)
{
  for (const auto value : values)
    if (word == toString(value)) return value;
  throw std::invalid_argument("'" + word + "' is no word of such a file");
}

/// Row by row; symmetric, so that columns will do.
std::vector<double> numbersOf(const Matrix6d& matrix)
{
  return {matrix.data(), matrix.data() + matrix.size()};
}

Matrix6d covarianceOf(const json& item)
{
  if (!item.contains("covariance")) return unknownCovariance();
  return Matrix6d(item.at("covariance").get<std::array<double, 36>>().data());
}

json toJson(const DetectedPose& pose)
{
  return {{"model", pose.model},
          {"pose", rowMajor(pose.T_cloud_model)},
          {"score", pose.score},
          {"votes", pose.votes},
          {"reliable", pose.reliable},
          {"reason", toString(pose.reason)},
          {"visible_fraction", pose.visible_fraction},
          {"rms_error", pose.rms_error_m},
          {"confirmed_px", pose.confirmed_px},
          {"slide_share", pose.slide_share},
          {"hold", pose.hold},
          {"spread", pose.spread},
          {"margin", pose.margin},
          {"support", pose.support},
          {"evidence_balance", pose.evidence_balance},
          {"looked_through", pose.looked_through},
          {"usual_looked_through", pose.usual_looked_through},
          {"outline_broken", pose.outline_broken},
          {"pierced", pose.pierced},
          {"usual_pierced", pose.usual_pierced},
          {"goes_on", pose.goes_on},
          {"claimed", pose.claimed},
          {"reliability", pose.reliability},
          {"covariance", numbersOf(pose.covariance)}};
}

json toJson(const MismatchingRegion& region)
{
  return {{"model", region.model},
          {"pose", rowMajor(region.box.T_cloud_box)},
          {"size", {region.box.size.x(), region.box.size.y(), region.box.size.z()}},
          {"best_pose", rowMajor(region.T_cloud_best)},
          {"reason", toString(region.reason)},
          {"score", region.score},
          {"reliability", region.reliability},
          {"hypotheses", region.hypotheses},
          {"detail", region.detail}};
}

Eigen::Isometry3d poseOf(const json& item, const char* key)
{
  const std::optional<Eigen::Isometry3d> pose = rigidPose(item.at(key).get<std::vector<double>>());
  if (!pose)
    throw std::invalid_argument(std::string(key) + " is not 16 numbers of a rigid transformation");
  return *pose;
}

DetectedPose poseFrom(const json& item)
{
  DetectedPose pose;
  pose.model = item.value("model", 0U);
  pose.T_cloud_model = poseOf(item, "pose");
  pose.score = item.at("score").get<double>();
  pose.votes = item.value("votes", 0.0);
  pose.reliable = item.at("reliable").get<bool>();
  pose.reason = fromWord(kReasons, item.value("reason", std::string()));
  pose.visible_fraction = item.value("visible_fraction", 0.0);
  pose.rms_error_m = item.value("rms_error", 0.0);
  pose.slide_share = item.value("slide_share", 0.0);
  pose.margin = item.value("margin", 1.0);
  pose.confirmed_px = item.value("confirmed_px", 0);
  pose.hold = item.value("hold", 0.0);
  pose.spread = item.value("spread", 0.0);
  pose.support = item.value("support", 0.0);
  pose.evidence_balance = item.value("evidence_balance", 0.0);
  pose.looked_through = item.value("looked_through", 0.0);
  pose.usual_looked_through = item.value("usual_looked_through", 0.0);
  pose.outline_broken = item.value("outline_broken", 0.0);
  pose.pierced = item.value("pierced", 0.0);
  pose.usual_pierced = item.value("usual_pierced", 0.0);
  pose.goes_on = item.value("goes_on", 0.0);
  pose.claimed = item.value("claimed", 0.0);
  pose.reliability = item.value("reliability", 0.0);
  pose.covariance = covarianceOf(item);
  return pose;
}

MismatchingRegion regionFrom(const json& item)
{
  MismatchingRegion region;
  region.model = item.value("model", 0U);
  region.box.T_cloud_box = poseOf(item, "pose");
  const auto size = item.at("size").get<std::array<double, 3>>();
  region.box.size = Eigen::Vector3d(size.data());
  region.T_cloud_best = poseOf(item, "best_pose");
  region.reason = fromWord(kReasons, item.at("reason").get<std::string>());
  region.score = item.at("score").get<double>();
  region.reliability = item.value("reliability", 0.0);
  region.hypotheses = item.at("hypotheses").get<std::size_t>();
  region.detail = item.value("detail", std::string());
  return region;
}

/// Text of a value; a byte that is not UTF-8 (of a path, say) is replaced.
std::string textOf(const json& value)
{
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// The members of an object one to a line, and so the items of those that are lists.
std::string textByLine(const json& root)
{
  std::string text;
  for (const auto& member : root.items())
  {
    text += (text.empty() ? "{\n" : ",\n") + json(member.key()).dump() + ": ";
    if (!member.value().is_array() || member.value().empty())
    {
      text += textOf(member.value());
      continue;
    }
    const char* separator = "[\n  ";
    for (const json& item : member.value())
    {
      text += separator + textOf(item);
      separator = ",\n  ";
    }
    text += "]";
  }
  return text + "\n}\n";
}

ResultFile fileFrom(const json& root)
{
  ResultFile file;
  file.frame_id = root.at("frame_id").get<std::string>();
  file.model_id = root.value("model_id", std::string());
  file.train_seconds = root.at("train_ms").get<double>() / kMilliseconds;
  DetectionResult& result = file.result;
  result.status = fromWord(kStatuses, root.at("status").get<std::string>());
  result.message = root.at("message").get<std::string>();
  result.seconds = root.at("time_ms").get<double>() / kMilliseconds;
  result.roi_points = root.at("roi_points").get<std::size_t>();
  result.noise_m = root.value("noise_m", 0.0);
  for (const auto& stage : root.at("stages_ms").items())
    result.stages.push_back({stage.key(), stage.value().get<double>() / kMilliseconds});
  for (const json& item : root.at("poses"))
    result.poses.push_back(poseFrom(item));
  for (const json& item : root.at("regions"))
    result.regions.push_back(regionFrom(item));
  return file;
}
}  // namespace

const char* toString(DetectionStatus status)
{
  switch (status)
  {
    case DetectionStatus::kOk:
      return "OK";
    case DetectionStatus::kNoPickablePose:
      return "NO_PICKABLE_POSE";
    case DetectionStatus::kRoiEmpty:
      return "ROI_EMPTY";
    case DetectionStatus::kTimeLimit:
      return "TIME_LIMIT";
    case DetectionStatus::kBadCloud:
      return "BAD_CLOUD";
  }
  return "";
}

std::string toJson(const ResultFile& file)
{
  const DetectionResult& result = file.result;
  json root = {{"frame_id", file.frame_id},
               {"model_id", file.model_id},
               {"status", toString(result.status)},
               {"message", result.message},
               {"time_ms", result.seconds * kMilliseconds},
               {"train_ms", file.train_seconds * kMilliseconds},
               {"stages_ms", json::object()},
               {"roi_points", result.roi_points},
               {"noise_m", result.noise_m},
               {"poses", json::array()},
               {"regions", json::array()}};
  for (const StageTime& stage : result.stages)
    root["stages_ms"][stage.name] = stage.seconds * kMilliseconds;
  for (const DetectedPose& pose : result.poses)
    root["poses"].push_back(toJson(pose));
  for (const MismatchingRegion& region : result.regions)
    root["regions"].push_back(toJson(region));
  return textByLine(root);
}

ResultFile loadResult(const std::string& path)
{
  const std::string text = readFile(path, kMaxResultBytes);
  try
  {
    return fileFrom(json::parse(text));
  }
  catch (const std::exception& error)  // of the library, or one of ours
  {
    throw InputError(path + " is no result of detect_poses (" + error.what() +
                     "): run detect_poses again");
  }
}
}  // namespace ppf_bin_picking

#include "pose_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ppf_bin_picking
{
namespace
{
constexpr double kDeterminantTolerance = 1e-3;

/// The error's square in units of the covariance.
double neesOf(const ScoredPose& pose, const Eigen::Isometry3d& T_camera_truth)
{
  if (pose.covariance(0, 0) < 0) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::AngleAxisd turn(pose.T_camera_model.linear() * T_camera_truth.linear().transpose());
  Eigen::Matrix<double, 6, 1> error;
  error << pose.T_camera_model.translation() - T_camera_truth.translation(),
      turn.angle() * turn.axis();
  return error.dot(pose.covariance.ldlt().solve(error));
}

/// Object and errors of a pose.
JudgedPose nearestObject(const ScoredPose& pose, const std::vector<TrueObject>& objects,
                         const PoseErrors& errors)
{
  JudgedPose judged;
  judged.score = pose.score;
  judged.reliable = pose.reliable;
  if (!isRigid(pose.T_camera_model)) return judged;
  NearestTruth nearest;
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    const NearestTruth truth =
        errors.mssd(pose.T_camera_model, objects[i].T_camera_model, nearest.error_m);
    if (!(truth.error_m < nearest.error_m)) continue;
    nearest = truth;
    judged.object = static_cast<int>(i);
  }
  if (judged.object < 0) return judged;
  judged.mssd_rel = nearest.error_m / errors.diameter();
  judged.translation_m = errors.translation(pose.T_camera_model, nearest.T_camera_model);
  judged.rotation_rad = errors.rotation(nearest.T_camera_model, pose.T_camera_model);
  judged.nees = neesOf(pose, nearest.T_camera_model);
  return judged;
}
}  // namespace

const char* toString(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::kRight:
      return "right";
    case Verdict::kWrong:
      return "wrong";
    case Verdict::kDuplicate:
      return "duplicate";
    case Verdict::kIgnored:
      return "ignored";
  }
  return "";
}

bool isRigid(const Eigen::Isometry3d& pose)
{
  return pose.matrix().topRows<3>().allFinite() &&
         std::abs(pose.linear().determinant() - 1) <= kDeterminantTolerance;
}

std::vector<std::size_t> byScore(const std::vector<ScoredPose>& poses)
{
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return poses[a].score > poses[b].score; });
  return order;
}

bool isTarget(const TrueObject& object, const JudgementRules& rules)
{
  return object.visibility >= rules.min_visibility;
}

std::vector<JudgedPose> judgePoses(const std::vector<ScoredPose>& poses,
                                   const std::vector<TrueObject>& objects, const PoseErrors& errors,
                                   const JudgementRules& rules)
{
  std::vector<JudgedPose> all;
  std::vector<bool> taken(objects.size(), false);
  for (const std::size_t index : byScore(poses))
  {
    JudgedPose judged = nearestObject(poses[index], objects, errors);
    judged.index = index;
    if (judged.mssd_rel < rules.threshold_rel)
    {
      const auto object = static_cast<std::size_t>(judged.object);
      judged.verdict = taken[object]                      ? Verdict::kDuplicate
                       : isTarget(objects[object], rules) ? Verdict::kRight
                                                          : Verdict::kIgnored;
      taken[object] = true;
    }
    all.push_back(judged);
  }
  return all;
}
}  // namespace ppf_bin_picking

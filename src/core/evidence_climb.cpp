#include "ppf_bin_picking/core/evidence_climb.hpp"

#include "ppf_bin_picking/core/pca.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"

#include <array>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr float kFirstStepRel = 0.012F;  // of the diameter
constexpr int kStepSizes = 3;            // each half the one before
constexpr int kRounds = 2;               // with each of them, at most
constexpr int kTrials = 12;              // there and back along three directions and about them
constexpr double kLeastKept = 0.9;       // of the weight that confirms the start
constexpr double kLeastGain = 0.1;       // of the balance, in that weight

using Directions = std::array<Eigen::Vector3f, 3>;

/// Across the part in the image, along it, and along the line of sight.
Directions directionsAt(const Eigen::Isometry3f& T_camera_model, const PpfModel& model,
                        const Eigen::Vector3f& long_axis)
{
  const Eigen::Vector3f sight = (T_camera_model * model.data().center).normalized();
  Eigen::Vector3f along = T_camera_model.linear() * long_axis;
  along -= along.dot(sight) * sight;
  along = along.norm() > 0.1F ? along.normalized() : sight.unitOrthogonal();
  return {sight.cross(along), along, sight};
}

/// The step of the k-th trial, as moved() takes it.
Vector6f trialStep(const Directions& directions, int k, float step_m)
{
  const float signed_m = k % 2 == 0 ? step_m : -step_m;
  Vector6f step = Vector6f::Zero();
  step.segment<3>(k < kTrials / 2 ? 3 : 0) =
      signed_m * directions[static_cast<std::size_t>(k / 2 % 3)];
  return step;
}

double fullBalance(const PoseEvidence& evidence)
{
  return evidenceBalance(evidence, evidence.confirmed_weight);
}

double fullScore(const PoseEvidence& evidence)
{
  return poseScore(evidence, evidence.confirmed_weight);
}

/// Tries a step each way and takes each that is better. False: none was.
bool improve(const RangeImage& image, const PpfModel& model, const DetectorConfig& config,
             const Eigen::Vector3f& long_axis, double least_confirmed, float step_m, Climb& best)
{
  const float lever_m = kLeverRel * static_cast<float>(model.diameter());
  const Directions directions = directionsAt(best.T_camera_model, model, long_axis);
  bool better = false;
  for (int k = 0; k < kTrials; ++k)
  {
    Climb next;
    next.T_camera_model = moved(best.T_camera_model, trialStep(directions, k, step_m),
                                best.T_camera_model * model.data().center, lever_m);
    next.evidence = gatherEvidence(image, model, next.T_camera_model, config);
    if (next.evidence.confirmed_weight < least_confirmed ||
        fullBalance(next.evidence) <= fullBalance(best.evidence) ||
        fullScore(next.evidence) <= fullScore(best.evidence))
      continue;
    best = std::move(next);
    better = true;
    k |= 1;  // not back again
  }
  return better;
}
}  // namespace

Climb climbEvidence(const RangeImage& image, const PpfModel& model,
                    const Eigen::Isometry3f& T_camera_model, const PoseEvidence& evidence,
                    const DetectorConfig& config)
{
  const Eigen::Vector3f long_axis =
      principalBox(model.data().points).T_cloud_box.linear().col(0).cast<float>();
  const double least_confirmed = kLeastKept * evidence.confirmed_weight;
  const double enough = fullBalance(evidence) + kLeastGain * evidence.confirmed_weight;
  Climb best{T_camera_model, evidence};
  float step_m = kFirstStepRel * static_cast<float>(model.diameter());
  for (int size = 0; size < kStepSizes; ++size, step_m /= 2)
    for (int round = 0; round < kRounds; ++round)
      if (!improve(image, model, config, long_axis, least_confirmed, step_m, best)) break;
  if (fullBalance(best.evidence) < enough) return {T_camera_model, evidence};
  return best;
}
}  // namespace ppf_bin_picking

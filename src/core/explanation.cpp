#include "ppf_bin_picking/core/explanation.hpp"

#include "ppf_bin_picking/core/pose_information.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"
#include "ppf_bin_picking/core/sparse_fit.hpp"

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
constexpr double kMostOutside = 0.5;  // of what is expected of a part in the region

/// A part's place: its centre and orientation.
struct Place
{
  Eigen::Vector3f center;
  Eigen::Quaternionf rotation;
};

class Explaining
{
public:
  Explaining(const PpfModel& model, const DetectorConfig& config, const Eigen::Isometry3f& pose)
      : model_(model), config_(config), here_(placeOf(pose))
  {
  }

  bool isNear(const Place& place) const
  {
    return (place.center - here_.center).norm() <= config_.group_distance_rel * model_.diameter() &&
           turnTo(place) <= config_.group_angle_rad;
  }
  bool isNear(const Eigen::Isometry3f& pose) const { return isNear(placeOf(pose)); }

  double shiftTo(const Eigen::Isometry3f& pose) const
  {
    return (placeOf(pose).center - here_.center).norm();
  }
  double turnTo(const Place& place) const
  {
    return model_.symmetries().rotationDistance(here_.rotation, place.rotation);
  }
  double turnTo(const Eigen::Isometry3f& pose) const { return turnTo(placeOf(pose)); }

  NearVotes votesAmong(const std::vector<PoseHypothesis>& hypotheses) const
  {
    NearVotes near;
    for (const PoseHypothesis& hypothesis : hypotheses)
    {
      near.best_votes = std::max<double>(near.best_votes, hypothesis.votes);
      if (!isNear({hypothesis.center, hypothesis.rotation})) continue;
      ++near.hypotheses;
      near.votes += hypothesis.votes;
    }
    return near;
  }

private:
  Place placeOf(const Eigen::Isometry3f& pose) const
  {
    return {pose * model_.data().center, Eigen::Quaternionf(pose.linear()).normalized()};
  }

  const PpfModel& model_;
  const DetectorConfig& config_;
  Place here_;
};

/// Index of the result's pose nearest to a place, if one is near it; -1: none.
int nearestRank(const Explaining& at, const DetectionResult& result)
{
  int rank = -1;
  double nearest_m = 0;
  for (std::size_t i = 0; i < result.poses.size(); ++i)
  {
    const Eigen::Isometry3f pose = result.poses[i].T_cloud_model.cast<float>();
    if (!at.isNear(pose) || (rank >= 0 && at.shiftTo(pose) >= nearest_m)) continue;
    rank = static_cast<int>(i);
    nearest_m = at.shiftTo(pose);
  }
  return rank;
}

/// Finds the standing pose that owns most of the explained one's pixels.
void findOwner(const RangeImage& image, const PpfModel& model, const DetectorConfig& config,
               const std::vector<Candidate>& candidates, const std::vector<SelectedPose>& selected,
               PoseExplanation& explanation)
{
  std::vector<float> weights(image.depth.size(), 0);
  for (const PoseEvidence::Pixel& pixel : explanation.evidence.confirmed)
    weights[pixel.index] = pixel.weight;
  double most = 0;
  for (const SelectedPose& standing : selected)
  {
    const Candidate& candidate = candidates[standing.candidate];
    double owned = 0;
    for (const PoseEvidence::Pixel& pixel : candidate.evidence.confirmed)
    {
      owned += weights[pixel.index];
      weights[pixel.index] = 0;  // the first in the order taken owns it
    }
    if (owned <= most) continue;
    most = owned;
    explanation.owner = nearestRank({model, config, candidate.T_camera_model}, explanation.result);
  }
  explanation.owned_share = most / std::max(1e-9, explanation.evidence.confirmed_weight);
}

PoseFate fateOf(const PoseExplanation& explanation, const DetectorConfig& config)
{
  if (explanation.evidence.visible_px == 0 && explanation.evidence.occluded == 0)
    return PoseFate::kOutOfSight;
  if (explanation.rank >= 0)
    return explanation.result.poses[static_cast<std::size_t>(explanation.rank)].reliable
               ? PoseFate::kReliable
               : PoseFate::kNotReliable;
  if (explanation.evidence.outside > kMostOutside * explanation.evidence.expected())
    return PoseFate::kOutsideRegion;
  if (explanation.candidates > 0) return PoseFate::kNotSelected;
  if (explanation.surface.hypotheses + explanation.boundary.hypotheses == 0)
    return PoseFate::kNoVotes;
  return explanation.quick_balance < config.min_sparse_balance ||
                 explanation.look_balance < config.min_look_balance
             ? PoseFate::kGivenUp
             : PoseFate::kNoCandidate;
}
}  // namespace

PoseExplanation explainPose(const RangeImage& image, const PpfModel& model,
                            const DetectorConfig& config, const Eigen::Isometry3d& T_camera_model,
                            const std::vector<Candidate>& candidates,
                            const std::vector<SelectedPose>& selected, DetectionResult result)
{
  const Eigen::Isometry3f pose = T_camera_model.cast<float>();
  const Explaining at(model, config, pose);
  PoseExplanation explanation;
  explanation.result = std::move(result);
  explanation.surface = at.votesAmong(explanation.result.distribution);
  explanation.boundary = at.votesAmong(boundaryHypotheses(image, model, config, Deadline()));
  explanation.candidates = static_cast<std::size_t>(
      std::count_if(candidates.begin(), candidates.end(),
                    [&](const Candidate& c) { return c.verified && at.isNear(c.T_camera_model); }));
  explanation.evidence = gatherEvidence(image, model, pose, config);
  const double confirmed = explanation.evidence.confirmed_weight;
  explanation.score = poseScore(explanation.evidence, confirmed);
  explanation.balance = evidenceBalance(explanation.evidence, confirmed);
  explanation.hold =
      std::max(0.0F, gatherInformation(image, model, pose, config).hold(model, pose));
  explanation.quick_balance = fitSparsely(image, model, pose, config).balance;
  Refinement refinement{pose};
  refineByOneLook(image, model, config, refinement);
  explanation.look_balance = refinement.balance;
  while (!refinement.done)
    refineByOneLook(image, model, config, refinement);
  const Eigen::Isometry3f& refined = refinement.T_camera_model;
  explanation.refined_shift_m = at.shiftTo(refined);
  explanation.refined_turn_rad = at.turnTo(refined);
  const PoseEvidence after = gatherEvidence(image, model, refined, config);
  explanation.refined_score = poseScore(after, after.confirmed_weight);
  explanation.rank = nearestRank(at, explanation.result);
  explanation.refined_rank = nearestRank({model, config, refined}, explanation.result);
  findOwner(image, model, config, candidates, selected, explanation);
  explanation.fate = fateOf(explanation, config);
  return explanation;
}
}  // namespace ppf_bin_picking

#include "pose_explanation.hpp"

#include "ppf_bin_picking/core/percent.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>

namespace ppf_bin_picking
{
namespace
{
std::string decimal(double value, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << value;
  return text.str();
}

std::string percentOf(double share)
{
  return percent(share, 1);
}

std::string votesText(const NearVotes& near)
{
  return std::to_string(near.hypotheses) + " hypotheses near it, " + decimal(near.votes, 1) +
         " votes (the best hypothesis anywhere has " + decimal(near.best_votes, 1) + ")";
}

/// The pixels by what was measured there.
std::string evidenceText(const PoseEvidence& evidence)
{
  const double all = std::max(1e-9, evidence.expected() + evidence.occluded);
  std::ostringstream text;
  text << "visible:      " << percentOf(visibleFraction(evidence)) << " of its surface, "
       << evidence.visible_px << " pixels; hidden " << percentOf(evidence.occluded / all) << "\n"
       << "confirmed:    " << percentOf(evidence.confirmed_weight / all) << ", "
       << evidence.confirmed.size() << " pixels, RMS error "
       << decimal(1000 * evidence.rms_error_m, 3) << " mm\n"
       << "contradicted: " << percentOf((evidence.looked_through + evidence.wrong_normal) / all)
       << ": looked through " << percentOf(evidence.looked_through / all) << ", wrong normal "
       << percentOf(evidence.wrong_normal / all) << "\n"
       << "missing:      " << percentOf(evidence.missing / all) << "; outside the region "
       << percentOf(evidence.outside / all) << "\n"
       << "outline:      " << evidence.outline_held << " pixels held, " << evidence.outline_broken
       << " broken; where something hides it " << evidence.stepped << " a step, "
       << evidence.pierced << " passed through\n";
  return text.str();
}

std::string poseName(const DetectionResult& result, int rank)
{
  const DetectedPose& pose = result.poses[static_cast<std::size_t>(rank)];
  return "pose " + std::to_string(rank) + " of the result (" +
         (pose.reliable ? "reliable" : toString(pose.reason)) + ", score " +
         decimal(pose.score, 3) + ")";
}

/// The sentence of the region that an unreliable pose became.
std::string detailOf(const DetectionResult& result, const DetectedPose& pose)
{
  for (const MismatchingRegion& region : result.regions)
    if (region.reason == pose.reason && region.T_cloud_best.isApprox(pose.T_cloud_model, 1e-9))
      return ": " + region.detail;
  return "";
}

std::string verdict(const PoseExplanation& explanation)
{
  const DetectionResult& result = explanation.result;
  switch (explanation.fate)
  {
    case PoseFate::kNotLookedFor:
      return "not looked for: " + result.message;
    case PoseFate::kOutOfSight:
      return "not looked for: the part would lie outside the image around the region; check the "
             "region, and give the pose in metres, in the cloud's frame";
    case PoseFate::kOutsideRegion:
      return "failed at the region of interest: " +
             percentOf(explanation.evidence.outside / explanation.evidence.expected()) +
             " of what it should show lies outside of it";
    case PoseFate::kNoVotes:
      return "failed at voting: no hypothesis is near it";
    case PoseFate::kNoCandidate:
      if (result.status == DetectionStatus::kTimeLimit)
        return "not known: the time limit came first; raise time_limit_s";
      return "failed at the choice of candidates: it has votes, but no pose near it was refined, "
             "or refinement led away from it";
    case PoseFate::kGivenUp:
      return "failed at the choice of candidates or the first looks: it has votes, but a candidate "
             "here is given up, as the first looks say too little for it";
    case PoseFate::kNotSelected:
      return explanation.owned_share > 0.5
                 ? "failed at the competition for pixels: other poses own them"
                 : "failed at the competition for pixels: what is left to it scores too little";
    case PoseFate::kNotReliable:
    {
      const DetectedPose& pose = result.poses[static_cast<std::size_t>(explanation.rank)];
      return std::string("failed at reliability, ") + toString(pose.reason) +
             detailOf(result, pose);
    }
    case PoseFate::kReliable:
      return "passed every gate: it is reliable";
  }
  return "";
}
}  // namespace

Eigen::Isometry3d poseFromText(const std::string& text)
{
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream stream(spaced);
  stream.imbue(std::locale::classic());
  std::array<double, 7> n{};
  for (double& number : n)
    stream >> number;
  std::string rest;
  const bool seven = !stream.fail() && !(stream >> rest);
  const auto finite = [](double number) { return std::isfinite(number); };
  if (!seven || !std::all_of(n.begin(), n.end(), finite))
    throw InputError("--explain is '" + text.substr(0, 100) +
                     "': give seven numbers, \"x y z qx qy qz qw\", T_cloud_model in metres");
  const double length = Eigen::Vector4d(n[3], n[4], n[5], n[6]).norm();
  if (!(length > 1e-9) || !std::isfinite(length))
    throw InputError("--explain is '" + text.substr(0, 100) +
                     "': its quaternion has no length; give qx qy qz qw, for no turn 0 0 0 1");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(n[6] / length, n[3] / length, n[4] / length, n[5] / length)
                      .normalized()
                      .toRotationMatrix();
  pose.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  return pose;
}

std::string explanationText(const PoseExplanation& explanation, const DetectorConfig& config)
{
  if (explanation.fate == PoseFate::kNotLookedFor)
    return "verdict:      " + verdict(explanation) + "\n";
  const DetectionResult& result = explanation.result;
  std::ostringstream text;
  text << "surface:      " << votesText(explanation.surface) << "\n"
       << "boundary:     " << votesText(explanation.boundary) << "\n"
       << "candidates:   " << explanation.candidates << " refined near it\n"
       << evidenceText(explanation.evidence) << "score:        " << decimal(explanation.score, 3)
       << " (min_score " << config.min_score << "), support "
       << decimal(explanation.evidence.support(), 3) << ", evidence balance "
       << decimal(explanation.balance, 0) << " pixels, hold " << decimal(explanation.hold, 4)
       << "\n"
       << "first looks:  balance " << decimal(explanation.quick_balance, 2)
       << " after a quick fit (min_sparse_balance " << config.min_sparse_balance << "), "
       << (config.icp_iterations > 0 ? decimal(explanation.look_balance, 2) : "none")
       << " after the first look (min_look_balance " << config.min_look_balance << ")\n"
       << "refinement:   moves it by " << decimal(1000 * explanation.refined_shift_m, 2)
       << " mm and " << decimal(180 / M_PI * explanation.refined_turn_rad, 2)
       << " degrees, to score " << decimal(explanation.refined_score, 3)
       << (explanation.rank >= 0 || explanation.refined_rank < 0
               ? ""
               : ", onto " + poseName(result, explanation.refined_rank))
       << "\n"
       << "coincides:    "
       << (explanation.rank < 0 ? "with no pose of the result" : poseName(result, explanation.rank))
       << "\n"
       << "owner:        "
       << (explanation.owner < 0 ? "no pose owns its pixels"
                                 : poseName(result, explanation.owner) + " owns " +
                                       percentOf(explanation.owned_share) + " of what confirms it")
       << "\n"
       << "verdict:      " << verdict(explanation) << "\n";
  return text.str();
}
}  // namespace ppf_bin_picking

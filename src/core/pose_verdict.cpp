#include "ppf_bin_picking/core/pose_verdict.hpp"

#include "ppf_bin_picking/core/pca.hpp"

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr double kNotable = 0.05;  // share of the edges that is worth telling

std::string percent(double share)
{
  return std::to_string(std::lround(100 * share)) + " %";
}

std::string rivalOf(const DetectedPose& pose)
{
  const std::string words = "another pose explains the same points ";
  return pose.margin < 0
             ? words + "better, with " + percent(-pose.margin) + " more evidence"
             : words + "almost as well, with " + percent(pose.margin) + " less evidence";
}

/// " (7 % is usual here)" of a share of which some is, or nothing.
std::string usualShare(double usual)
{
  return usual > 0 ? " (" + percent(usual) + " is usual here)" : "";
}

/// What pulled the reliability down.
std::string weaknessOf(const DetectedPose& pose)
{
  switch (pose.main_doubt)
  {
    case UnreliableReason::kRunnerUp:
      return rivalOf(pose);
    case UnreliableReason::kSlippage:
      return (pose.goes_on > kNotable ? "the measured surface goes on at " + percent(pose.goes_on) +
                                            " of its edges, and "
                                      : std::string()) +
             "what is seen of it hardly keeps it from sliding or turning";
    case UnreliableReason::kSpread:
      return "its hypotheses spread over " + percent(pose.spread) + " of the part's diameter";
    case UnreliableReason::kOverlap:
      return "better poses explain " + percent(pose.claimed) + " of its surface";
    default:
      return "the cloud lies behind " + percent(pose.looked_through) + " of the surface" +
             usualShare(pose.usual_looked_through) + ", " + percent(pose.visible_fraction) +
             " is not hidden, " + std::to_string(pose.confirmed_px) + " pixels confirm it";
  }
}

/// The gates of the score that the pose fails. Empty: none.
std::string smallEvidence(const DetectedPose& pose, const DetectorConfig& config)
{
  std::string failed;
  const auto add = [&failed](const std::string& words)
  { failed += (failed.empty() ? "" : ", ") + words; };
  if (pose.score < config.min_score)
    add("score " + percent(pose.score) + " (min_score " + percent(config.min_score) + ")");
  if (pose.visible_fraction < config.min_visible_share)
    add("not hidden " + percent(pose.visible_fraction) + " (min_visible_share " +
        percent(config.min_visible_share) + ")");
  if (pose.confirmed_px < config.min_confirmed_px)
    add("confirmed by " + std::to_string(pose.confirmed_px) + " pixels (min_confirmed_px " +
        std::to_string(config.min_confirmed_px) + ")");
  return failed;
}

/// The gates of the mismatch test before those of the score.
PoseVerdict ambiguityVerdict(const DetectedPose& pose, const ClusterShare& share,
                             const PpfModel& model, const DetectorConfig& config)
{
  const double spread_m = sideSum(share.box);
  if (config.clustering == Clustering::kDbscan &&
      spread_m > config.max_spread_rel * model.diameter())
    return {UnreliableReason::kSpread,
            "the hypotheses spread over " + percent(spread_m / model.diameter()) +
                " of the part's diameter, more than max_spread_rel allows (" +
                percent(config.max_spread_rel) + ")"};
  if (pose.slide_share > config.max_slide_share && pose.hold < config.firm_hold)
    return {UnreliableReason::kSlippage,
            "the measured surface goes on beyond " + percent(pose.slide_share) +
                " of the outline that should stop a slide (max_slide_share " +
                percent(config.max_slide_share) + "), and little else does"};
  if (pose.outline_broken > config.max_outline_broken)
    return {UnreliableReason::kLowScore,
            "the measured surface does not end at " + percent(pose.outline_broken) +
                " of its edges (max_outline_broken " + percent(config.max_outline_broken) +
                "), so that nothing ends where the part ends"};
  if (pose.pierced - pose.usual_pierced > config.max_pierced)
    return {UnreliableReason::kLowScore,
            "the measured surface passes through " + percent(pose.pierced) + " of its edges" +
                usualShare(pose.usual_pierced) + ", more than max_pierced allows (" +
                percent(config.max_pierced) + "), so that it lies within something larger"};
  if (pose.margin < config.min_margin)
    return {UnreliableReason::kRunnerUp,
            rivalOf(pose) + " (min_margin " + percent(config.min_margin) + ")"};
  return {};
}
}  // namespace

PoseVerdict verdictOf(const DetectedPose& pose, bool rivals_known, const ClusterShare& share,
                      const PpfModel& model, const DetectorConfig& config)
{
  if (!rivals_known)
    return {UnreliableReason::kRunnerUp,
            "the time limit came before every other pose there was looked at: raise time_limit_s"};
  if (config.mismatch_test)
  {
    PoseVerdict verdict = ambiguityVerdict(pose, share, model, config);
    if (verdict.reason != UnreliableReason::kNone) return verdict;
  }
  const std::string small = smallEvidence(pose, config);
  if (!small.empty()) return {UnreliableReason::kLowScore, small};
  if (!config.mismatch_test || pose.reliability >= config.min_reliability) return {};
  return {pose.main_doubt, "right with a probability of " + percent(pose.reliability) +
                               " only (min_reliability " + percent(config.min_reliability) +
                               "): " + weaknessOf(pose)};
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/pose_verdict.hpp"

#include "ppf_bin_picking/core/pca.hpp"
#include "ppf_bin_picking/core/percent.hpp"

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr double kClose = 0.1;  // a rival with less evidence by less than this

/// The words before and after the share by which a rival has less or more evidence.
std::string rivalBefore(const DetectedPose& pose)
{
  const std::string words = "another pose explains the same points ";
  if (pose.margin < 0) return words + "better, with ";
  return words + (pose.margin < kClose ? "almost as well, with " : "with ");
}

std::string rivalAfter(const DetectedPose& pose)
{
  return pose.margin < 0 ? " more evidence" : " less evidence";
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
    case ReliabilityTerm::kScore:
      return "the cloud confirms only " + percent(pose.score) + " of what it should see of it";
    case ReliabilityTerm::kMargin:
      return rivalBefore(pose) + percent(std::abs(pose.margin)) + rivalAfter(pose);
    case ReliabilityTerm::kHold:
      return "what is seen of it hardly keeps it from sliding or turning";
    case ReliabilityTerm::kSlideShare:
      return "the measured surface goes on beyond " + percent(pose.slide_share) +
             " of the outline that should stop a slide";
    case ReliabilityTerm::kSpread:
      return "its hypotheses spread over " + percent(pose.spread) + " of the part's diameter";
    case ReliabilityTerm::kLookedThrough:
      return "the cloud lies behind " + percent(pose.looked_through) + " of the surface" +
             usualShare(pose.usual_looked_through);
    case ReliabilityTerm::kGoesOn:
      return "the measured surface goes on at " + percent(pose.goes_on) + " of its edges";
    case ReliabilityTerm::kClaimed:
      return "better poses explain " + percent(pose.claimed) + " of its surface";
    case ReliabilityTerm::kConfirmed:
      return "only " + std::to_string(pose.confirmed_px) + " pixels confirm it";
    case ReliabilityTerm::kVisible:
      return "only " + percent(pose.visible_fraction) + " of it is not hidden";
  }
  return "";
}

/// "<before>42 %<between>35 %<after>" of a share and the limit that it fails.
std::string told(const std::string& before, double share, const std::string& between, double limit,
                 const std::string& after)
{
  const ShareAndLimit text = percentBeside(share, limit);
  return before + text.share + between + text.limit + after;
}

/// The gates of the score that the pose fails. Empty: none.
std::string smallEvidence(const DetectedPose& pose, const DetectorConfig& config)
{
  std::string failed;
  const auto add = [&failed](const std::string& words)
  { failed += (failed.empty() ? "" : ", ") + words; };
  if (pose.score < config.min_score)
    add(told("score ", pose.score, " (min_score ", config.min_score, ")"));
  if (pose.visible_fraction < config.min_visible_share)
    add(told("not hidden ", pose.visible_fraction, " (min_visible_share ", config.min_visible_share,
             ")"));
  if (pose.confirmed_px < config.min_confirmed_px)
    add("confirmed by " + std::to_string(pose.confirmed_px) + " pixels (min_confirmed_px " +
        std::to_string(config.min_confirmed_px) + ")");
  return failed;
}

/// The gates of the mismatch test before those of the score.
PoseVerdict ambiguityVerdict(const DetectedPose& pose, const ClusterShare& share,
                             const PpfModel& model, const DetectorConfig& config)
{
  const double spread = sideSum(share.box) / model.diameter();
  if (config.clustering == Clustering::kDbscan && spread > config.max_spread_rel)
    return {UnreliableReason::kSpread,
            told("the hypotheses spread over ", spread,
                 " of the part's diameter, more than max_spread_rel allows (",
                 config.max_spread_rel, ")")};
  if (pose.slide_share > config.max_slide_share && pose.hold < config.firm_hold)
    return {UnreliableReason::kSlippage,
            told("the measured surface goes on beyond ", pose.slide_share,
                 " of the outline that should stop a slide (max_slide_share ",
                 config.max_slide_share, "), and little else does")};
  if (pose.outline_broken > config.max_outline_broken)
    return {UnreliableReason::kLowScore,
            told("the measured surface does not end at ", pose.outline_broken,
                 " of its edges (max_outline_broken ", config.max_outline_broken,
                 "), so that nothing ends where the part ends")};
  if (pose.pierced - pose.usual_pierced > config.max_pierced)
    return {
        UnreliableReason::kLowScore,
        told("the measured surface passes through ", pose.pierced,
             " of its edges" + usualShare(pose.usual_pierced) + ", more than max_pierced allows (",
             config.max_pierced, "), so that it lies within something larger")};
  if (pose.margin < config.min_margin)
    return {UnreliableReason::kRunnerUp,
            told(rivalBefore(pose), std::abs(pose.margin), rivalAfter(pose) + " (min_margin ",
                 config.min_margin, ")")};
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
  return {reasonOf(pose.main_doubt),
          told("right with a probability of ", pose.reliability, " only (min_reliability ",
               config.min_reliability, "): ") +
              weaknessOf(pose)};
}
}  // namespace ppf_bin_picking

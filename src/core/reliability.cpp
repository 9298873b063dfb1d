#include "ppf_bin_picking/core/reliability.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// One term of the sum whose logistic function is the probability.
struct Term
{
  double value;          ///< Of the pose.
  double weight;         ///< Per unit of the value.
  double of_right_ones;  ///< Mean value of right poses.
  UnreliableReason reason;
};

// Fitted as scripts/fit_reliability does, before reference points of symmetric parts were thinned
// out.
constexpr double kIntercept = -1.453;

std::array<Term, 10> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), 0.093, 2.518, UnreliableReason::kLowScore},
      {std::clamp(pose.margin, -0.2, 0.5), 4.831, 0.455, UnreliableReason::kRunnerUp},
      {std::log10(std::max(pose.hold, 0.001)), 2.748, -1.116, UnreliableReason::kSlippage},
      {pose.slide_share, -1.809, 0.229, UnreliableReason::kSlippage},
      {std::min(pose.spread, 2.0), -1.784, 0.203, UnreliableReason::kSpread},
      {pose.looked_through, -10.780, 0.016, UnreliableReason::kLowScore},
      {pose.outline_broken, -2.520, 0.125, UnreliableReason::kLowScore},
      {pose.claimed, -14.401, 0.001, UnreliableReason::kOverlap},
      {std::log10(std::max(pose.confirmed_px, 30)), 1.957, 3.298, UnreliableReason::kLowScore},
      {std::min(pose.visible_fraction, 1.0), 2.254, 0.751, UnreliableReason::kLowScore},
  }};
}
}  // namespace

Reliability assessReliability(const DetectedPose& pose)
{
  Reliability reliability;
  double sum = kIntercept;
  double worst = 0;
  for (const Term& term : termsOf(pose))
  {
    sum += term.weight * term.value;
    const double against = term.weight * (term.value - term.of_right_ones);
    if (against >= worst) continue;
    worst = against;
    reliability.weakest = term.reason;
  }
  reliability.probability = 1 / (1 + std::exp(-sum));
  return reliability;
}
}  // namespace ppf_bin_picking

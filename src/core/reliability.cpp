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
constexpr double kIntercept = -1.735;

std::array<Term, 9> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), 0.099, 2.417, UnreliableReason::kLowScore},
      {std::clamp(pose.margin, -0.2, 0.5), 5.675, 0.452, UnreliableReason::kRunnerUp},
      {std::log10(std::max(pose.hold, 0.001)), 2.641, -1.144, UnreliableReason::kSlippage},
      {std::min(pose.spread, 2.0), -1.425, 0.192, UnreliableReason::kSpread},
      {pose.looked_through, -14.271, 0.015, UnreliableReason::kLowScore},
      {pose.outline_broken, -2.958, 0.213, UnreliableReason::kLowScore},
      {pose.claimed, -10.731, 0.001, UnreliableReason::kOverlap},
      {std::log10(std::max(pose.confirmed_px, 30)), 1.856, 3.288, UnreliableReason::kLowScore},
      {std::min(pose.visible_fraction, 1.0), 1.971, 0.757, UnreliableReason::kLowScore},
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

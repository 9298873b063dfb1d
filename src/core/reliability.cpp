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

// Fitted by scripts/fit_reliability; docs/reliability.md shows how well.
constexpr double kIntercept = -0.679;

std::array<Term, 11> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), 0.183, 2.447, UnreliableReason::kLowScore},
      {std::clamp(pose.margin, -0.2, 0.5), 5.683, 0.453, UnreliableReason::kRunnerUp},
      {std::log10(std::max(pose.hold, 0.001)), 2.526, -1.127, UnreliableReason::kSlippage},
      {pose.slide_share, -0.806, 0.170, UnreliableReason::kSlippage},
      {std::min(pose.spread, 2.0), -0.843, 0.191, UnreliableReason::kSpread},
      {pose.looked_through, -21.366, 0.012, UnreliableReason::kLowScore},
      {pose.outline_broken, -0.138, 0.159, UnreliableReason::kLowScore},
      {pose.goes_on, -4.835, 0.042, UnreliableReason::kSlippage},
      {pose.claimed, -16.535, 0.001, UnreliableReason::kOverlap},
      {std::log10(std::max(pose.confirmed_px, 30)), 1.340, 3.298, UnreliableReason::kLowScore},
      {std::min(pose.visible_fraction, 1.0), 1.907, 0.781, UnreliableReason::kLowScore},
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

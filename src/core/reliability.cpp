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
constexpr double kIntercept = 0.001;

std::array<Term, 10> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), 0.050, 2.503, UnreliableReason::kLowScore},
      {std::clamp(pose.margin, -0.2, 0.5), 5.641, 0.445, UnreliableReason::kRunnerUp},
      {std::log10(std::max(pose.hold, 0.001)), 2.555, -1.132, UnreliableReason::kSlippage},
      {pose.slide_share, -1.615, 0.201, UnreliableReason::kSlippage},
      {std::min(pose.spread, 2.0), -1.243, 0.190, UnreliableReason::kSpread},
      {pose.looked_through, -19.166, 0.012, UnreliableReason::kLowScore},
      {pose.outline_broken, -1.027, 0.136, UnreliableReason::kLowScore},
      {pose.claimed, -16.615, 0.001, UnreliableReason::kOverlap},
      {std::log10(std::max(pose.confirmed_px, 30)), 1.318, 3.298, UnreliableReason::kLowScore},
      {std::min(pose.visible_fraction, 1.0), 1.636, 0.780, UnreliableReason::kLowScore},
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

#include "ppf_bin_picking/core/reliability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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
constexpr double kIntercept = -0.794;

// As in scripts/reliability_lib/usual.py: what is usual is fitted together with the weights.
constexpr std::size_t kZeros = 5;  // beside the poses that show what is usual
constexpr double kMostUsual = 0.1;

std::array<Term, 10> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), 0.031, 2.466, UnreliableReason::kLowScore},
      {std::clamp(pose.margin, -0.2, 0.5), 5.802, 0.454, UnreliableReason::kRunnerUp},
      {std::log10(std::max(pose.hold, 0.001)), 2.532, -1.112, UnreliableReason::kSlippage},
      {pose.slide_share, -0.662, 0.170, UnreliableReason::kSlippage},
      {std::min(pose.spread, 2.0), -0.334, 0.195, UnreliableReason::kSpread},
      {std::max(pose.looked_through - pose.usual_looked_through, 0.0), -26.058, 0.008,
       UnreliableReason::kLowScore},
      {pose.goes_on, -5.454, 0.042, UnreliableReason::kSlippage},
      {pose.claimed, -15.854, 0.001, UnreliableReason::kOverlap},
      {std::log10(std::max(pose.confirmed_px, 30)), 1.522, 3.322, UnreliableReason::kLowScore},
      {std::min(pose.visible_fraction, 1.0), 1.325, 0.800, UnreliableReason::kLowScore},
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

void setUsualShares(const std::vector<bool>& shows, std::vector<DetectedPose>& poses)
{
  const auto usual = [&](std::size_t pose, double DetectedPose::*share)
  {
    std::vector<double> shares(kZeros, 0.0);
    for (std::size_t other = 0; other < poses.size(); ++other)
      if (shows[other] && other != pose && poses[other].model == poses[pose].model)
        shares.push_back(poses[other].*share);
    const auto middle = shares.begin() + static_cast<std::ptrdiff_t>((shares.size() - 1) / 2);
    std::nth_element(shares.begin(), middle, shares.end());
    return std::min(*middle, kMostUsual);
  };
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    poses[i].usual_looked_through = usual(i, &DetectedPose::looked_through);
    poses[i].usual_pierced = usual(i, &DetectedPose::pierced);
  }
}
}  // namespace ppf_bin_picking

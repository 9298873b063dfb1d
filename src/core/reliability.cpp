#include "ppf_bin_picking/core/reliability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ppf_bin_picking
{
namespace
{
/// What a term counts.
struct Weight
{
  double per_unit;       ///< Of the value.
  double of_right_ones;  ///< Mean value of right poses.
};

/// One term of the sum whose logistic function is the probability.
struct Term
{
  double value;  ///< Of the pose.
  ReliabilityTerm name;
  Weight in_region;
  Weight in_whole_cloud;
};

// Fitted by scripts/fit_reliability; docs/reliability.md shows how well.
constexpr double kInterceptInRegion = -0.530;
constexpr double kInterceptInWholeCloud = -2.185;

// As in scripts/reliability_lib/usual.py: what is usual is fitted together with the weights.
constexpr std::size_t kZeros = 5;  // beside the poses that show what is usual
constexpr double kMostUsual = 0.1;

std::array<Term, 10> termsOf(const DetectedPose& pose)
{
  const double score = std::clamp(pose.score, 0.2, 0.98);
  return {{
      {std::log(score / (1 - score)), ReliabilityTerm::kScore, {0.117, 2.641}, {0.756, 2.928}},
      {std::clamp(pose.margin, -0.2, 0.5),
       ReliabilityTerm::kMargin,
       {5.749, 0.456},
       {5.826, 0.460}},
      {std::log10(std::max(pose.hold, 0.001)),
       ReliabilityTerm::kHold,
       {2.462, -1.098},
       {2.232, -1.079}},
      {pose.slide_share, ReliabilityTerm::kSlideShare, {-0.825, 0.135}, {-2.151, 0.071}},
      {std::min(pose.spread, 2.0), ReliabilityTerm::kSpread, {-0.161, 0.180}, {-3.005, 0.185}},
      {std::max(pose.looked_through - pose.usual_looked_through, 0.0),
       ReliabilityTerm::kLookedThrough,
       {-27.505, 0.005},
       {-19.623, 0.003}},
      {pose.goes_on, ReliabilityTerm::kGoesOn, {-4.992, 0.034}, {-4.803, 0.018}},
      {pose.claimed, ReliabilityTerm::kClaimed, {-14.391, 0.001}, {-13.445, 0.001}},
      {std::log10(std::max(pose.confirmed_px, 30)),
       ReliabilityTerm::kConfirmed,
       {1.441, 3.144},
       {1.282, 2.974}},
      {std::min(pose.visible_fraction, 1.0),
       ReliabilityTerm::kVisible,
       {1.046, 0.798},
       {1.459, 0.810}},
  }};
}
}  // namespace

Reliability assessReliability(const DetectedPose& pose, bool whole_cloud)
{
  Reliability reliability;
  double sum = whole_cloud ? kInterceptInWholeCloud : kInterceptInRegion;
  double worst = 0;
  for (const Term& term : termsOf(pose))
  {
    const Weight& weight = whole_cloud ? term.in_whole_cloud : term.in_region;
    sum += weight.per_unit * term.value;
    const double against = weight.per_unit * (term.value - weight.of_right_ones);
    if (against >= worst) continue;
    worst = against;
    reliability.main_doubt = term.name;
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

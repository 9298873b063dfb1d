/// @file Why a pose cannot be trusted.
#pragma once

#include <cstdint>

namespace ppf_bin_picking
{
/// Why a pose or a region is not reliable. The numbers are those of MismatchRegion.msg.
enum class UnreliableReason : std::uint8_t
{
  kSpread = 0,    ///< Its cluster of hypotheses is too large: a mismatching region.
  kSlippage = 1,  ///< The fit can slide.
  kLowScore = 2,  ///< The cloud confirms too little of it.
  kOverlap = 3,   ///< It shares space with a better pose.
  kRunnerUp = 4,  ///< Another pose explains the same points almost as well.
  kNone = 255,    ///< Reliable.
};

/// `SPREAD`, `SLIPPAGE`, `LOW_SCORE`, `OVERLAP`, `RUNNER_UP`; empty for kNone.
const char* toString(UnreliableReason reason);

/// What the probability that a pose is right is computed from; the fields of DetectedPose.
enum class ReliabilityTerm : std::uint8_t
{
  kScore,
  kMargin,
  kHold,
  kSlideShare,
  kSpread,
  kLookedThrough,  ///< Beyond what is usual.
  kGoesOn,
  kClaimed,
  kConfirmed,
  kVisible,
};

/// Why a pose is not reliable that a term pulls down.
UnreliableReason reasonOf(ReliabilityTerm term);
}  // namespace ppf_bin_picking

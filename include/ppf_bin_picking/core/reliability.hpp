/// @file The probability that a pose is right, from all that is known of it.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"

namespace ppf_bin_picking
{
/// A pose's reliability and what speaks most against it.
struct Reliability
{
  double probability = 0;  ///< That the pose is right. [0, 1]
  /// The reason of the term that lowers it most, compared with the average right pose.
  UnreliableReason weakest = UnreliableReason::kLowScore;
};

/// Logistic regression (Cox 1958) over what verification and the ambiguity tests found: score,
/// margin, hold, slide share, spread, the shares looked through and claimed by better poses, broken
/// edges, visible share and confirmed pixels.
///
/// Fitted on simulated scenes of the package's own parts, foreign objects and shiny surfaces among
/// them; docs/reliability.md tells what it keeps of parts that it was not fitted on.
/// Scores and shares are in [0, 1].
/// @param pose  All fields but reliability, reliable and reason are read.
Reliability assessReliability(const DetectedPose& pose);
}  // namespace ppf_bin_picking

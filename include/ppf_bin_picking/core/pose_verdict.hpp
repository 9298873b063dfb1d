/// @file Whether a pose can be trusted, and the sentence that says why not.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/mismatch.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <string>

namespace ppf_bin_picking
{
/// What the first gate that a pose fails says of it.
struct PoseVerdict
{
  UnreliableReason reason = UnreliableReason::kNone;  ///< kNone: it passes all, and can be trusted.
  std::string detail;                                 ///< One sentence with the figures.
};

/// Takes a pose through the gates. Without the mismatch test the score's alone are left.
/// @param pose          All but reliable and reason is read.
/// @param rivals_known  False if the time limit left a pose beside it unverified; see Ambiguity.
/// @param share         Its share of its cluster's hypotheses.
PoseVerdict verdictOf(const DetectedPose& pose, bool rivals_known, const ClusterShare& share,
                      const PpfModel& model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

/// @file Whether a pose can be trusted, and the sentence that says why not.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/mismatch.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <string>

namespace ppf_bin_picking
{
/// Why a pose cannot be trusted; kNone if it can. The first gate that it fails decides.
/// @param pose          All but reliable and reason is read.
/// @param rivals_known  False if the time limit left a pose beside it unverified; see Ambiguity.
/// @param share         Its share of its cluster's hypotheses.
UnreliableReason reasonOf(const DetectedPose& pose, bool rivals_known, const ClusterShare& share,
                          const PpfModel& model, const DetectorConfig& config);

/// One sentence with the figures that made an unreliable pose's reason.
/// @param spread  The box of its share of the hypotheses.
std::string detailOf(const DetectedPose& pose, bool rivals_known, const OrientedBox& spread,
                     const PpfModel& model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

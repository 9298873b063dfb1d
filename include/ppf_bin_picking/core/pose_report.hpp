/// @file From standing candidates to the answer: reliability, reasons, regions, order.
#pragma once

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/selection.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// The candidates that stand together, in the order taken; see selectPoses.
std::vector<SelectedPose> selectCandidates(const std::vector<Candidate>& candidates,
                                           std::size_t pixels);

/// Writes the standing candidates as poses, reliable ones first, and a region for every one that is
/// not, with its reason. Mismatching clusters without a pose become regions, too.
void reportPoses(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                 const std::vector<Candidate>& candidates,
                 const std::vector<SelectedPose>& selected, const RangeImage& image,
                 DetectionResult& result);
}  // namespace ppf_bin_picking

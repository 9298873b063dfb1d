/// @file From standing candidates to the answer: reliability, reasons, regions, order.
#pragma once

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/mismatch.hpp"
#include "ppf_bin_picking/core/pose_verdict.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/selection.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// The candidates that stand together, in the order taken; see selectPoses.
std::vector<SelectedPose> selectCandidates(const std::vector<Candidate>& candidates,
                                           std::size_t pixels);

/// The region that a pose becomes which is not reliable.
/// @param share  Its share of its cluster's hypotheses.
MismatchingRegion regionOf(const DetectedPose& pose, const PpfModel& model,
                           const PoseVerdict& verdict, const ClusterShare& share);

/// Puts reliable poses first, both parts in the order of their reliability, and of their score
/// where it is the same; regions in the order of their score.
void sortResult(DetectionResult& result);

/// Writes the standing candidates as poses, reliable ones first, and a region for every one that is
/// not, with its reason. Mismatching clusters without a pose become regions, too.
void reportPoses(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                 const std::vector<Candidate>& candidates,
                 const std::vector<SelectedPose>& selected, const RangeImage& image,
                 DetectionResult& result);
}  // namespace ppf_bin_picking

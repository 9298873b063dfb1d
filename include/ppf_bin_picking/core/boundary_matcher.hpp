/// @file Voting by boundary points: they find flat parts, whose faces alone can slide.
#pragma once

#include "ppf_bin_picking/core/boundary.hpp"
#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/parallel.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// Each boundary point of the scene, with every other one no farther off than the model's
/// diameter, votes for the model's boundary points that have a neighbour in the same place. A
/// matched point gives a whole pose: its frame on the other's.
/// @param scene     Thinned out to boundarySpacing(), camera frame.
/// @param deadline  Once passed, no further point is begun.
/// @return Hypotheses in the order of the points, whatever the number of threads; at most
///         peaks_per_reference of each. Their model index is 0, their cluster -1.
std::vector<PoseHypothesis> matchBoundary(const std::vector<BoundaryPoint>& scene,
                                          const PpfModel& model, const DetectorConfig& config,
                                          const Deadline& deadline);
}  // namespace ppf_bin_picking

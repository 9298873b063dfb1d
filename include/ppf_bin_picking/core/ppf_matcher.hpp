/// @file Voting: the sampled scene's point pairs against a model's table.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/parallel.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// One full vote in the integer accumulators; weights are rounded to multiples of its inverse.
constexpr std::uint32_t kVoteUnit = 16;

/// The weight of a pair's votes: max(v_min, 1 - lambda |n1 . n2|), in units of 1 / kVoteUnit, at
/// least 1.
std::uint32_t voteWeight(const Eigen::Vector3f& n1, const Eigen::Vector3f& n2, double lambda,
                         double v_min);

/// Votes of every pair of a reference point and a scene point no farther off than the model's
/// diameter (Drost et al. 2010, section 3.3), and the peaks of each reference point's accumulator
/// as poses.
/// @param scene     Sampled at the model's step [m]; normals towards the camera.
/// @param deadline  Once passed, no further reference point is begun.
/// @return Hypotheses in the order of the reference points, whatever the number of threads; at most
///         peaks_per_reference of each. Their model index is 0, their cluster -1.
std::vector<PoseHypothesis> matchModel(const OrientedPoints& scene, const PpfModel& model,
                                       const DetectorConfig& config, const Deadline& deadline);
}  // namespace ppf_bin_picking

/// @file From the cells of an accumulator to distinct poses; private to the core.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include "vote_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
constexpr std::size_t kMaxPeakCells = 200;  ///< Cells that are looked at for further peaks.

/// Cells with at least a share of the most votes, most votes first, of equal ones the first.
inline std::vector<std::uint32_t> strongestCells(const std::vector<std::uint32_t>& votes,
                                                 double share)
{
  const std::uint32_t most = largestOf(votes.data(), votes.size());
  const auto least =
      std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::ceil(share * most)));
  std::vector<std::uint32_t> strongest;
  collectFrom(least, votes.data(), votes.size(), strongest);
  std::stable_sort(strongest.begin(), strongest.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return votes[a] > votes[b]; });
  if (strongest.size() > kMaxPeakCells) strongest.resize(kMaxPeakCells);
  return strongest;
}

/// The poses of the first cells that are different poses, at most peaks_per_reference.
/// @param pose_of_cell  Gives the hypothesis of a cell.
template <class PoseOfCell>
std::vector<PoseHypothesis> distinctPeaks(const std::vector<std::uint32_t>& cells,
                                          const PpfModel& model, const DetectorConfig& config,
                                          PoseOfCell pose_of_cell)
{
  const float same_place_m =
      static_cast<float>(config.group_distance_rel) * model.data().diameter_m;
  std::vector<PoseHypothesis> peaks;
  for (const std::uint32_t cell : cells)
  {
    if (peaks.size() == static_cast<std::size_t>(config.peaks_per_reference)) break;
    const PoseHypothesis candidate = pose_of_cell(cell);
    const auto same = [&](const PoseHypothesis& known)
    {
      return (known.center - candidate.center).norm() < same_place_m &&
             model.symmetries().rotationDistance(known.rotation, candidate.rotation) <
                 config.group_angle_rad;
    };
    if (std::none_of(peaks.begin(), peaks.end(), same)) peaks.push_back(candidate);
  }
  return peaks;
}
}  // namespace ppf_bin_picking

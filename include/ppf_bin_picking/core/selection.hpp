/// @file Which verified poses may stand together.
#pragma once

#include "ppf_bin_picking/core/verification.hpp"

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// A pose that stands, and what is left to it.
struct SelectedPose
{
  std::size_t candidate = 0;  ///< Index into the evidence given.
  double confirmed = 0;       ///< Weight of its confirmed pixels that no better pose explains.
  double balance = 0;         ///< Evidence for it after the better ones, see evidenceBalance().
};

/// Lets poses compete for pixels: again and again the pose with the best balance of evidence is
/// taken and owns the pixels that confirm it; they speak against every other pose that claims them.
/// Poses left with a score below 0.4 are left out; a negative balance alone leaves none out.
/// @param candidates  None is null.
/// @param pixels      Of the image.
/// @return In the order taken.
std::vector<SelectedPose> selectPoses(const std::vector<const PoseEvidence*>& candidates,
                                      std::size_t pixels);
}  // namespace ppf_bin_picking

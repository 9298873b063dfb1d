/// @file How easily a standing pose could be another one: where it could slide, and how far it
/// leads over its rivals.
#pragma once

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/selection.hpp"

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// What speaks against trusting a pose although it fits.
struct Ambiguity
{
  /// Of the outline that would stop the worst slide, the share that does not. [0, 1]
  double slide_share = 0;
  /// Outline pixels beyond which the measured surface goes on and is not that of another held pose.
  double goes_on_px = 0;
  /// Lead in evidence over the best other pose that claims the same pixels, relative to the pose's
  /// confirmed pixels. 1 without a rival; below 0 the rival has more.
  double margin = 1;
  /// False if the time limit left a candidate within a diameter unverified: it may be a rival.
  bool rivals_known = true;
};

/// Looks at each standing pose.
///
/// Slides: an outline beyond which the surface goes on does not hold a pose, unless the surface
/// there belongs to another standing pose that is held itself; so trust spreads from parts that end
/// freely to those that touch them.
///
/// Rivals: candidates other than the pose that claim at least half of its confirmed pixels; what
/// third poses own does not count for them.
/// @param selected  As selectCandidates() returned them.
/// @param pixels    Of the image.
std::vector<Ambiguity> assessAmbiguity(const std::vector<const PpfModel*>& models,
                                       const DetectorConfig& config,
                                       const std::vector<Candidate>& candidates,
                                       const std::vector<SelectedPose>& selected,
                                       std::size_t pixels);
}  // namespace ppf_bin_picking

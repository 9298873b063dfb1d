/// @file The probability that a pose is right, from all that is known of it.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// A pose's reliability and what speaks most against it.
struct Reliability
{
  double probability = 0;  ///< That the pose is right. [0, 1]
  /// What lowers it most, compared with the average right pose.
  ReliabilityTerm main_doubt = ReliabilityTerm::kScore;
};

/// Logistic regression (Cox 1958) over what verification and the ambiguity tests found: score,
/// margin, hold, slide share, spread, the share looked through beyond what is usual, that claimed
/// by better poses, edges beyond which the surface goes on, visible share and confirmed pixels.
///
/// Fitted on simulated scenes of the package's own parts, foreign objects and shiny surfaces among
/// them; docs/reliability.md tells what it keeps of parts that it was not fitted on. Searches of
/// the whole cloud have weights of their own: rims, walls and tables, which nothing keeps from
/// being taken for parts there, look right in other terms than parts do. Scores and shares are in
/// [0, 1].
/// @param pose         All fields but reliability, main_doubt, reliable and reason are read.
/// @param whole_cloud  Whether the pose was found without a region of interest.
Reliability assessReliability(const DetectedPose& pose, bool whole_cloud);

/// Poses that pass every gate and have this probability while nothing is usual show what is usual.
constexpr double kShowsUsual = 0.8;

/// Writes what the cloud shows where right poses are: usual_looked_through and usual_pierced.
/// Sensors lose the flanks of shiny parts and the rims of all and show what lies behind them, at
/// every part of a scene alike, and of no sensor is it known beforehand how much. Of each pose
/// either share is the median over the other poses of its model that show it and over five zeros,
/// so that few poses change nothing; at most 0.1, so that a scene full of something else does not
/// excuse itself.
/// @param shows  Whether a pose shows what is usual; one for each pose.
/// @param poses  Of one detection.
void setUsualShares(const std::vector<bool>& shows, std::vector<DetectedPose>& poses);
}  // namespace ppf_bin_picking

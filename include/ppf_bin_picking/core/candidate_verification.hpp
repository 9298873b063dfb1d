/// @file From candidates to verified ones: refinement, verification, look-alikes.
#pragma once

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/selection.hpp"

#include <functional>
#include <vector>

namespace ppf_bin_picking
{
/// Refines the candidates and gathers their evidence, from the one with the most votes outwards, so
/// that a deadline leaves a place of which all candidates are verified. Leaves out those that the
/// cloud contradicts after a quick fit (min_sparse_balance) or after the first look of the
/// refinement (min_look_balance).
/// @param lap  Called with the name of each stage at its end, several times.
void verifyCandidates(const RangeImage& image, const std::vector<const PpfModel*>& models,
                      const DetectorConfig& config, const Deadline& deadline,
                      const std::function<void(const char*)>& lap,
                      std::vector<Candidate>& candidates);

/// What the standing poses may be confused with: each one that scores enough, turned as
/// PpfModel::lookAlikes() says, unless a candidate has come there. Not yet verified; the votes and
/// the cluster are the standing pose's.
std::vector<Candidate> lookAlikesOf(const std::vector<const PpfModel*>& models,
                                    const DetectorConfig& config,
                                    const std::vector<Candidate>& candidates,
                                    const std::vector<SelectedPose>& selected);

/// Lets the standing poses that the cloud says little for climb to where it says more, see
/// climbEvidence(), unless they lie within a larger surface. Replaces their pose and evidence and
/// sets `climbed`; after it the poses are to be selected anew.
/// @return False if the deadline passed first: poses that had not begun stay as they are.
bool climbStanding(const RangeImage& image, const std::vector<const PpfModel*>& models,
                   const DetectorConfig& config, const Deadline& deadline,
                   const std::vector<SelectedPose>& selected, std::vector<Candidate>& candidates);
}  // namespace ppf_bin_picking

/// @file Average recall by the three errors of the BOP challenge.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/pose_errors.hpp"

#include "pose_judgement.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// How many targets of a scene are recalled: the mean over the thresholds of an error, so that the
/// sum over scenes, divided by their targets, is the average recall AR.
struct RecalledTargets
{
  double vsd = 0;
  double mssd = 0;
  double mspd = 0;
};

/// What the camera measured.
struct DepthView
{
  PinholeCamera camera;
  std::vector<float> depth;  ///< Along z [m], row after row; 0 without measurement.
};

/// Recall as in Hodan et al., BOP Challenge 2020 on 6D Object Localization (ECCV workshops 2020),
/// section 2, accuracy score. For each threshold, poses take targets in the order of their scores:
/// each the free target of the lowest error below the threshold. Thresholds:
///  - VSD: 0.05, 0.10, .. 0.50, each with tolerances tau of 5, 10, .. 50 % of the diameter; delta
///  is
///    5 mm, which the challenge uses for its industrial data set, ITODD.
///  - MSSD: 5, 10, .. 50 % of the diameter.
///  - MSPD: 5, 10, .. 50 px for an image 640 px wide, and in proportion for others.
/// Other than in the challenge, all given poses take part, not only as many as there are targets.
/// @param poses    Those that are not rigid are passed over.
/// @param targets  The objects to be found.
RecalledTargets recalledTargets(const std::vector<ScoredPose>& poses,
                                const std::vector<TrueObject>& targets, const PoseErrors& errors,
                                const RenderableMesh& mesh, const DepthView& view);
}  // namespace ppf_bin_picking

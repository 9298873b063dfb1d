/// @file What became of a given pose in a detection, and why.
#pragma once

#include "ppf_bin_picking/core/candidate_search.hpp"
#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"
#include "ppf_bin_picking/core/selection.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
/// Where a pose got to. It failed at the first gate it did not pass.
enum class PoseFate
{
  kNotLookedFor,   ///< No point in the region, or a cloud that cannot be worked on.
  kOutOfSight,     ///< Nothing of the part lies in the image around the region.
  kOutsideRegion,  ///< It is none of the result's; what explains it lies outside the region.
  kNoVotes,        ///< Neither surfaces nor boundaries voted for anything near it.
  kNoCandidate,    ///< Votes, but others had more: no refined candidate is near it.
  kGivenUp,        ///< The same, and at this pose one would be given up at the first looks.
  kNotSelected,    ///< A candidate, but better poses own its pixels, or it scores too little.
  kNotReliable,    ///< It stands but is not reliable; the pose has the reason.
  kReliable,       ///< It stands and is reliable.
};

/// Hypotheses near a pose. Near is nearer than group_distance_rel and turned by less than
/// group_angle_rad, symmetries counted, throughout this file.
struct NearVotes
{
  std::size_t hypotheses = 0;
  double votes = 0;       ///< Their sum, in units of one full vote.
  double best_votes = 0;  ///< Of the best hypothesis anywhere.
};

/// All that is known of a given pose.
struct PoseExplanation
{
  PoseFate fate = PoseFate::kNotLookedFor;
  NearVotes surface;           ///< Votes of surface pairs.
  NearVotes boundary;          ///< Votes of boundary pairs.
  std::size_t candidates = 0;  ///< Refined candidates near the pose.
  PoseEvidence evidence;       ///< Of the pose as given.
  double score = 0;            ///< Of the pose as given, nobody else owning its pixels.
  double balance = 0;          ///< Likewise, see evidenceBalance().
  double hold = 0;             ///< See pose_information.hpp.
  double quick_balance = 0;    ///< After a quick fit, see SparseFit.
  double look_balance = 0;  ///< After the refinement's first look, see Refinement; 1 without one.
  double refined_shift_m = 0;   ///< How far refinement takes the part's centre ...
  double refined_turn_rad = 0;  ///< ... and turns the part, symmetries counted.
  double refined_score = 0;     ///< The score after that.
  int refined_rank = -1;        ///< Index of the result's pose near the refined one; -1: none.
  int rank = -1;                ///< Index of the pose near it in the result; -1: none.
  int owner = -1;               ///< Index of the result's pose that owns most of its pixels, or -1.
  double owned_share = 0;       ///< Share of its confirmed weight that this one owns.
  DetectionResult result;       ///< Of the detection.
};

/// Says what became of a pose in a detection that is done.
/// @param T_camera_model  The pose [m].
/// @param result          Of the detection.
PoseExplanation explainPose(const RangeImage& image, const PpfModel& model,
                            const DetectorConfig& config, const Eigen::Isometry3d& T_camera_model,
                            const std::vector<Candidate>& candidates,
                            const std::vector<SelectedPose>& selected, DetectionResult result);
}  // namespace ppf_bin_picking

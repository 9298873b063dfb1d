/// @file From hypotheses to candidates: DBSCAN over centres, greedy grouping of poses.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Hypotheses that are one pose.
struct PoseGroup
{
  Eigen::Quaternionf rotation =
      Eigen::Quaternionf::Identity();  ///< Of the member with the most votes.
  Eigen::Vector3f center =
      Eigen::Vector3f::Zero();  ///< Mean of the members, weighted by votes [m].
  float votes = 0;              ///< Sum of the members.
  std::int32_t cluster = -1;    ///< Of all members; -1 under greedy clustering.
  std::size_t members = 0;
};

/// Keeps the hypotheses with at least min_votes_rel of the most votes: the probable pose
/// distribution.
std::vector<PoseHypothesis> highVoteHypotheses(const std::vector<PoseHypothesis>& hypotheses,
                                               double min_votes_rel);

/// DBSCAN radius [m]: eps_rel of the diameter, or one sampling step if eps_rel is 0.
double dbscanRadius(const DetectorConfig& config, const PpfModel& model);

/// DBSCAN core size: minpts, or, if that is 0, a twentieth of the reference points on the quarter
/// of a part's surface that a camera sees, at least 3.
std::size_t dbscanCoreSize(const DetectorConfig& config, const PpfModel& model);

/// Labels each hypothesis with its cluster, writes it into `cluster`, and describes the clusters:
/// the box of their centres and whether its sides add up to more than max_spread_rel diameters.
std::vector<HypothesisCluster> clusterHypotheses(const DetectorConfig& config,
                                                 const PpfModel& model,
                                                 std::vector<PoseHypothesis>& hypotheses);

/// Greedy grouping (Drost et al. 2010, section 3.4): the pose with the most votes gathers those no
/// farther off than group_distance_rel diameters and group_angle_rad, symmetries counted; then the
/// next one left.
/// @param hypotheses  Of one model, all of one cluster or regardless of clusters.
/// @return Most votes first.
std::vector<PoseGroup> groupPoses(const DetectorConfig& config, const PpfModel& model,
                                  const std::vector<PoseHypothesis>& hypotheses);

/// The candidates of a model: groups inside each cluster, at most poses_per_cluster of each; under
/// greedy clustering groups of all hypotheses. Most votes first.
std::vector<PoseGroup> candidatePoses(const DetectorConfig& config, const PpfModel& model,
                                      const std::vector<PoseHypothesis>& hypotheses,
                                      std::size_t clusters);
}  // namespace ppf_bin_picking

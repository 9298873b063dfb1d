/// @file Which clusters slide, and whose share of a cluster does.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// The part of a cluster that belongs to one pose.
struct ClusterShare
{
  OrientedBox box;  ///< Of the hypotheses' centres.
  std::size_t hypotheses = 0;
};

/// Divides clusters among the poses that stand in them: each hypothesis goes to the pose of its
/// cluster with the nearest centre. Where a cluster chains over touching parts, each part gets its
/// own; where one pose stands on a surface that it can slide along, it gets the whole spread. With
/// one pose a cluster the share is the cluster.
/// @param centers   Of the poses [m].
/// @param clusters  Of the poses; negative ones get an empty share.
std::vector<ClusterShare> shareClusters(const std::vector<PoseHypothesis>& distribution,
                                        const std::vector<Eigen::Vector3f>& centers,
                                        const std::vector<std::int32_t>& clusters);
}  // namespace ppf_bin_picking

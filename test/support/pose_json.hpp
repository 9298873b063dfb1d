/// @file Poses, results and ground truth as JSON.
#pragma once

#include "ppf_bin_picking/io/rigid_pose.hpp"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace ppf_bin_picking
{
/// An item of a result's `poses`.
inline nlohmann::json foundPose(const Eigen::Isometry3d& pose, double score, bool reliable)
{
  return {{"pose", rowMajor(pose)}, {"score", score}, {"reliable", reliable}};
}

/// An item of a ground truth's `objects`.
inline nlohmann::json trueObject(const Eigen::Isometry3d& pose, double visibility)
{
  return {{"pose", rowMajor(pose)}, {"visibility", visibility}};
}
}  // namespace ppf_bin_picking

/// @file detect_poses --explain: the pose from its text, and what is known of it as text.
#pragma once

#include "ppf_bin_picking/core/explanation.hpp"

#include <string>

namespace ppf_bin_picking
{
/// Reads `x y z qx qy qz qw`, metres, separated by spaces or commas; the quaternion of any length.
/// @throw InputError if it is anything else.
Eigen::Isometry3d poseFromText(const std::string& text);

/// An explanation in lines, the verdict last.
std::string explanationText(const PoseExplanation& explanation, const DetectorConfig& config);
}  // namespace ppf_bin_picking

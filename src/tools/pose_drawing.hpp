/// @file Poses drawn over the depth image, for people.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
struct DrawnPose
{
  Eigen::Isometry3f T_camera_model = Eigen::Isometry3f::Identity();
  bool reliable = false;  ///< Green if so, otherwise red.
  std::string label;
};

/// The depth image as a shaded relief (black: not measured), and beside it the same with the part's
/// edges at each pose and its label. Enlarged to a size that a person can judge.
cv::Mat drawPoses(const RangeImage& image, const RenderableMesh& part,
                  const std::vector<DrawnPose>& poses);
}  // namespace ppf_bin_picking

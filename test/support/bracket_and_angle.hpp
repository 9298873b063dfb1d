/// @file Two parts on a table for the detector to find.
#pragma once

#include "ppf_bin_picking/core/detector.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
inline DetectorConfig coarseConfig()
{
  DetectorConfig config;
  config.model.step_rel = 0.1;
  return config;
}

/// A bracket and, beside it, an angle on a table; the region begins a little above the table.
class BracketAndAngle : public ::testing::Test
{
protected:
  static constexpr float kNoise_m = 0.0002F;

  PointCloud cloud(double turn_rad = 0) const
  {
    const Eigen::Isometry3d T_turned = poseOf(turn_rad, {0, 0, 1}, {0, 0, 0});
    return renderCloud({{squareMesh(0.5F), T_turned * T_camera_table_},
                        {bracketMesh(), T_turned * T_camera_bracket_},
                        {angleMesh(), T_turned * T_camera_angle_}},
                       smallCamera(), kNoise_m);
  }
  DetectionResult detect(const DetectorConfig& config) const
  {
    return Detector(config).detect(cloud(), bracket_, roi_);
  }

  Eigen::Isometry3d T_camera_table_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.62}) * poseOf(0.3, {1, 0, 0}, {0, 0, 0});
  Eigen::Isometry3d T_camera_bracket_ = T_camera_table_ * poseOf(0.7, {0, 0, 1}, {-0.05, 0.01, 0});
  Eigen::Isometry3d T_camera_angle_ = T_camera_table_ * poseOf(2.5, {0, 0, 1}, {0.07, 0, 0});
  RegionOfInterest roi_{T_camera_table_, {-0.14, -0.1, 0.004}, {0.14, 0.1, 0.1}};
  PpfModel bracket_ = PpfModel::train(bracketMesh(), SymmetryGroup(), coarseConfig().model);
};
}  // namespace ppf_bin_picking

/// @file How firmly the measured surfaces and edges hold a pose, and so how uncertain it is.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace ppf_bin_picking
{
using Vector6f = Eigen::Matrix<float, 6, 1>;
using Matrix6f = Eigen::Matrix<float, 6, 6>;

/// Length, of the diameter, that makes turns comparable to shifts.
constexpr float kLeverRel = 0.35F;

/// How a point's coordinate along a direction changes with a small motion (turn about the centre,
/// scaled by the lever; shift).
/// @param arm        From the centre to the point, in levers.
/// @param direction  Unit length.
Vector6f motionJacobian(const Eigen::Vector3f& arm, const Eigen::Vector3f& direction);

/// Turns and shifts a pose by a step, as motionJacobian() measures it.
/// @param step      Turn about the centre, times the lever, and shift, in the camera frame [m].
/// @param center    Camera frame [m].
Eigen::Isometry3f moved(const Eigen::Isometry3f& T_camera_model, const Vector6f& step,
                        const Eigen::Vector3f& center, float lever_m);

/// The turns of a revolution or a sphere, as small motions about the part's centre, unit length.
std::vector<Vector6f> invisibleMotions(const PpfModel& model,
                                       const Eigen::Isometry3f& T_camera_model);

/// What the measurements of one image say about small motions of a pose: turns about the part's
/// centre and shifts, in the camera frame. J is motionJacobian along the surface's normal or,
/// across the outline, out of the part (Gelfand and Guibas 2004, section 3; the outline is ours).
struct PoseInformation
{
  Matrix6f surface = Matrix6f::Zero();  ///< Mean of J J^T over the pixels in sight, confirmed ones.
  Matrix6f outline = Matrix6f::Zero();  ///< ... over the outline in sight, where the surface ends.

  /// The smallest eigenvalue of surface + outline: how firmly the worst motion is held. Motions
  /// that the part's symmetries make invisible are left out. About 0: the pose can slide.
  float hold(const PpfModel& model, const Eigen::Isometry3f& T_camera_model) const;
};

/// Renders the part at the pose and gathers what holds it.
PoseInformation gatherInformation(const RangeImage& image, const PpfModel& model,
                                  const Eigen::Isometry3f& T_camera_model,
                                  const DetectorConfig& config);
}  // namespace ppf_bin_picking

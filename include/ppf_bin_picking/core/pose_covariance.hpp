/// @file How uncertain a fitted pose is.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

namespace ppf_bin_picking
{
/// Covariance of a fitted pose: the inverse of the information that its confirmed pixels and its
/// outline hold, each weighed by the variance of its measured residuals and divided by how many
/// neighbours err alike. That number is measured, too: over blocks of pixels, the mean square of
/// the residuals' sums is, for independent ones, the sum of their squares.
/// What whole faces err alike the fit takes up, so that residuals do not show it: a factor of 8,
/// from true errors in simulation, stands for that.
///
/// What nothing holds has the variance of the prior: 0.35 diameters and a radian. A turn about an
/// axis of revolution, or any turn of a ball, has that of an even distribution over the full turn
/// (pi^2 / 3).
/// @param T_cloud_model  A refined pose, mesh frame to camera frame [m].
/// @return Of x y z rx ry rz [m, rad]: shifts of the mesh's origin and turns about it, along the
///         cloud frame's axes.
Matrix6d poseCovariance(const RangeImage& image, const PpfModel& model,
                        const Eigen::Isometry3d& T_cloud_model, const DetectorConfig& config);
}  // namespace ppf_bin_picking

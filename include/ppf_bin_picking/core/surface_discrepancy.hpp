/// @file How much of a part's visible surface differs between two poses.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/pinhole_camera.hpp"

#include <vector>

namespace ppf_bin_picking
{
/// Visible surface discrepancy (VSD) of Hodan et al., BOP Challenge 2020 on 6D Object Localization
/// (ECCV workshops 2020), section 2, pose-error functions: of the pixels in which the part is
/// visible at either pose, the share in which it is not visible at both, or at distances from the
/// camera that differ by a tolerance or more.
///
/// A pixel of the part is visible unless the measured distance is shorter by more than
/// `visibility_m`; it is where nothing was measured, as in that challenge; and for the found pose
/// it is where the part is visible at the true one.
///
/// @param found, truth  The part at the two poses, by renderPart() with the same camera.
/// @param measured      Depth along z [m] of every pixel of the camera, row after row; 0 without
///                      measurement.
/// @param visibility_m  Tolerance delta of the visibility test.
/// @param tolerances_m  Misalignment tolerances tau.
/// @return For each tolerance the error in [0, 1]; 1 where the part is visible at neither pose.
/// @throw std::invalid_argument if `measured` is not as large as the camera's image.
std::vector<double> visibleSurfaceDiscrepancy(const RenderedPart& found, const RenderedPart& truth,
                                              const PinholeCamera& camera,
                                              const std::vector<float>& measured,
                                              double visibility_m,
                                              const std::vector<double>& tolerances_m);
}  // namespace ppf_bin_picking

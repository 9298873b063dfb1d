/// @file How far a depth image is off by noise, and the gates that follow.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

namespace ppf_bin_picking
{
/// Standard deviation of the depth from pixel to pixel within the region of interest, from the
/// image itself [m]: that of the mask [1 -2 1; -2 4 -2; 1 -2 1], which any sum of a function of the
/// column and one of the row leaves at zero (Immerkaer, Fast Noise Variance Estimation, Computer
/// Vision and Image Understanding 64, 1996, section 2). In place of the paper's mean the median of
/// the absolute values, to which edges do not matter. 0 where fewer than 200 windows are measured.
/// Errors that neighbouring pixels share are not seen.
/// @param image  Its depth and in_roi are read.
double depthNoise(const RangeImage& image);

/// A surface confirms a part within this distance [m]: depth_gate_rel of the diameter, or twice and
/// a half the image's noise if that is more, at most 0.05 diameters.
double depthGate(const RangeImage& image, double diameter_m, const DetectorConfig& config);
}  // namespace ppf_bin_picking

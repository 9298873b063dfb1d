/// @file Planes through the neighbourhoods of an image's pixels, on plain arrays. No Eigen here:
/// normal_kernel.cpp is compiled for several instruction sets, and the processor's is chosen when
/// the program starts.
#pragma once

#include <cstddef>
#include <vector>

namespace ppf_bin_picking
{
constexpr int kPlaneLanes = 8;  ///< Pixels of a row that are worked on together.

/// A depth image with a margin of unmeasured pixels, wide enough for whole groups of lanes.
struct PaddedDepth
{
  /// @param depth_m  Row by row [m]; 0 where nothing was measured.
  PaddedDepth(const float* depth_m, int width, int height, int margin_px);

  int stride;  ///< Pixels from one row to the next.
  int margin;
  std::vector<float> depth_m;
  std::vector<float> inverse_m;  ///< [1/m]; 0 where nothing was measured.

  /// Of a pixel of the image, or up to margin beyond.
  std::size_t index(int u, int v) const
  {
    return static_cast<std::size_t>(v + margin) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(u + margin);
  }
};

/// 1/z = a du + b dv + c about kPlaneLanes pixels, one lane each; c is 0 where no plane fits.
struct PlaneLanes
{
  float a[kPlaneLanes];
  float b[kPlaneLanes];
  float c[kPlaneLanes];
};

/// How planes are fitted.
struct PlaneFit
{
  int radius_px;        ///< Half window; at most the image's margin.
  float gate_m;         ///< Neighbours are taken within this of the pixel's own depth ...
  float second_gate_m;  ///< ... and then within this of the first plane.
  float least_pixels;   ///< So many are needed.
};

/// Fits the planes about the pixels (u, v) to (u + kPlaneLanes - 1, v) by least squares.
void fitPlanes(const PaddedDepth& image, const PlaneFit& fit, int u, int v, PlaneLanes& planes);
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/depth_noise.hpp"

#include "range_image_makers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kLeastWindows = 200;
constexpr double kMedianOfNormal = 0.6745;  // of the absolute value, in standard deviations
constexpr double kMaskNorm = 6;             // root of the sum of the mask's squares
constexpr double kGateNoises = 2.5;
constexpr double kWidestGateRel = 0.05;

/// The mask about a pixel; NaN unless all of its window is measured.
float maskAt(const RangeImage& image, int u, int v)
{
  constexpr std::array<float, 3> kSecondDifference = {1, -2, 1};
  float sum = 0;
  for (int dv = 0; dv < 3; ++dv)
    for (int du = 0; du < 3; ++du)
    {
      const float z = image.depth[image.index(u + du - 1, v + dv - 1)];
      if (!(z > 0)) return std::numeric_limits<float>::quiet_NaN();
      sum += kSecondDifference[static_cast<std::size_t>(du)] *
             kSecondDifference[static_cast<std::size_t>(dv)] * z;
    }
  return sum;
}
}  // namespace

double depthNoise(const RangeImage& image)
{
  std::vector<float> magnitudes;
  for (int v = 1; v + 1 < image.camera.height; v += 2)
    for (int u = 1; u + 1 < image.camera.width; ++u)
    {
      if (image.in_roi[image.index(u, v)] == 0) continue;
      const float value = maskAt(image, u, v);
      if (!std::isnan(value)) magnitudes.push_back(std::abs(value));
    }
  if (magnitudes.size() < kLeastWindows) return 0;
  return percentile(magnitudes, 0.5) / (kMedianOfNormal * kMaskNorm);
}

double depthGate(const RangeImage& image, double diameter_m, const DetectorConfig& config)
{
  const double own_m = config.depth_gate_rel * diameter_m;
  return std::max(own_m, std::min(kGateNoises * image.noise_m, kWidestGateRel * diameter_m));
}
}  // namespace ppf_bin_picking

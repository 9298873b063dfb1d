#include "ppf_bin_picking/core/surface_discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ppf_bin_picking
{
namespace
{
/// Depth of a part along z [m] in a pixel of the image; 0 where the part is not.
float depthIn(const RenderedPart& part, int u, int v)
{
  const int column = u - part.left;
  const int row = v - part.top;
  const bool inside = column >= 0 && column < part.width && row >= 0 && row < part.height;
  return inside ? part.depthAt(column, row) : 0.0F;
}

/// A window that holds both.
RenderedPart windowOfBoth(const RenderedPart& a, const RenderedPart& b)
{
  RenderedPart both;
  both.left = std::min(a.left, b.left);
  both.top = std::min(a.top, b.top);
  both.width = std::max(a.left + a.width, b.left + b.width) - both.left;
  both.height = std::max(a.top + a.height, b.top + b.height) - both.top;
  return both;
}
}  // namespace

std::vector<double> visibleSurfaceDiscrepancy(const RenderedPart& found, const RenderedPart& truth,
                                              const PinholeCamera& camera,
                                              const std::vector<float>& measured,
                                              double visibility_m,
                                              const std::vector<double>& tolerances_m)
{
  if (measured.size() != static_cast<std::size_t>(camera.width) * camera.height)
    throw std::invalid_argument("the measured depth has " + std::to_string(measured.size()) +
                                " pixels, the camera another number: give the camera's own image");
  std::size_t visible = 0;
  std::vector<std::size_t> alike(tolerances_m.size(), 0);
  const RenderedPart window = windowOfBoth(found, truth);
  for (int v = window.top; v < window.top + window.height; ++v)
  {
    for (int u = window.left; u < window.left + window.width; ++u)
    {
      const float z_found = depthIn(found, u, v);
      const float z_truth = depthIn(truth, u, v);
      if (z_found == 0 && z_truth == 0) continue;
      const double per_z = camera.ray(static_cast<float>(u), static_cast<float>(v)).norm();
      const float z = measured[static_cast<std::size_t>(v) * camera.width + u];
      const auto not_hidden = [&](float z_part)
      { return z_part > 0 && (z == 0 || (z_part - z) * per_z <= visibility_m); };
      const bool sees_truth = not_hidden(z_truth);
      const bool sees_found = not_hidden(z_found) || (sees_truth && z_found > 0);
      if (sees_truth || sees_found) ++visible;
      if (!sees_truth || !sees_found) continue;
      for (std::size_t i = 0; i < tolerances_m.size(); ++i)
        if (std::abs(z_found - z_truth) * per_z < tolerances_m[i]) ++alike[i];
    }
  }
  std::vector<double> errors;
  for (const std::size_t count : alike)
    errors.push_back(
        visible == 0 ? 1.0 : 1.0 - static_cast<double>(count) / static_cast<double>(visible));
  return errors;
}
}  // namespace ppf_bin_picking

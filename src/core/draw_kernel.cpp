#include "draw_kernel.hpp"

#include "instruction_sets.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// Narrows [first, last] to where value + k * step >= 0.
inline void keepNotNegative(float value, float step, float& first, float& last)
{
  if (step > 0)
    first = std::max(first, -value / step);
  else if (step < 0)
    last = std::min(last, -value / step);
  else if (value < 0)
    last = -1;
}

/// 1 where the surface may end between two pixels beside each other, else 0.
inline std::int32_t mayEnd(float here_m, float next_m, float fall_m)
{
  const bool ends = (next_m == 0) | (next_m - here_m >= fall_m);
  return ends ? 1 : 0;
}
}  // namespace

PPF_BIN_PICKING_CLONES
void drawTriangle(const ImageVertex& a, const ImageVertex& b, const ImageVertex& c,
                  std::uint32_t index, const DrawWindow& window)
{
  const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (area == 0) return;
  const int u0 = std::max(window.left, static_cast<int>(std::ceil(std::min({a.u, b.u, c.u}))));
  const int u1 = std::min(window.left + window.width - 1,
                          static_cast<int>(std::floor(std::max({a.u, b.u, c.u}))));
  const int v0 = std::max(window.top, static_cast<int>(std::ceil(std::min({a.v, b.v, c.v}))));
  const int v1 = std::min(window.top + window.height - 1,
                          static_cast<int>(std::floor(std::max({a.v, b.v, c.v}))));
  const float scale = 1.0F / area;
  // Weights of b and c grow by a constant from pixel to pixel; so does 1/z.
  const float step_b = (c.v - a.v) * scale, step_c = -(b.v - a.v) * scale;
  const float step_z = step_b * (b.inverse_z - a.inverse_z) + step_c * (c.inverse_z - a.inverse_z);
  for (int v = v0; v <= v1; ++v)
  {
    const float du = static_cast<float>(u0) - a.u, dv = static_cast<float>(v) - a.v;
    const float weight_b = du * step_b - dv * (c.u - a.u) * scale;
    const float weight_c = du * step_c + dv * (b.u - a.u) * scale;
    float first = 0, last = static_cast<float>(u1 - u0);
    keepNotNegative(weight_b, step_b, first, last);
    keepNotNegative(weight_c, step_c, first, last);
    keepNotNegative(1 - weight_b - weight_c, -step_b - step_c, first, last);
    if (!(first <= last)) continue;
    const float inverse_z0 = a.inverse_z + weight_b * (b.inverse_z - a.inverse_z) +
                             weight_c * (c.inverse_z - a.inverse_z);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(v - window.top) * window.width;
    float* __restrict const inverse_z = window.inverse_z + row + (u0 - window.left);
    std::uint32_t* __restrict const triangle = window.triangle + row + (u0 - window.left);
    const int k1 = static_cast<int>(last);
    for (int k = static_cast<int>(std::ceil(first)); k <= k1; ++k)
    {
      const float here = inverse_z0 + static_cast<float>(k) * step_z;
      const bool is_nearer = here > inverse_z[k];
      inverse_z[k] = is_nearer ? here : inverse_z[k];
      triangle[k] = is_nearer ? index : triangle[k];
    }
  }
}

PPF_BIN_PICKING_CLONES
void invertDepth(float* values, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
    values[i] = values[i] > 0 ? 1.0F / values[i] : 0.0F;
}

PPF_BIN_PICKING_CLONES
void markFalls(const float* depth_m, int width, int height, float fall_m, std::uint8_t* marks)
{
  std::fill(marks, marks + static_cast<std::ptrdiff_t>(width) * height, std::uint8_t{0});
  for (int row = 0; row < height; ++row)
  {
    const float* const here = depth_m + static_cast<std::ptrdiff_t>(row) * width;
    std::uint8_t* __restrict const marked = marks + static_cast<std::ptrdiff_t>(row) * width;
    const bool is_border = row == 0 || row == height - 1;
    for (int u = 1; u < width - 1 && !is_border; ++u)
    {
      const std::int32_t ends =
          mayEnd(here[u], here[u - 1], fall_m) | mayEnd(here[u], here[u + 1], fall_m) |
          mayEnd(here[u], here[u - width], fall_m) | mayEnd(here[u], here[u + width], fall_m);
      marked[u] = static_cast<std::uint8_t>(here[u] > 0 ? ends : 0);
    }
    for (int u = 0; u < width; u += is_border ? 1 : std::max(1, width - 1))
      marked[u] = here[u] > 0;
  }
}
}  // namespace ppf_bin_picking

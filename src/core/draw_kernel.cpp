#include "draw_kernel.hpp"

#include "instruction_sets.hpp"
#include "lanes.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// A span of each of some rows, in pixels from a column on.
struct Spans
{
  Floats first;
  Floats last;
};

/// Narrows the spans to where value + k * step >= 0.
PPF_BIN_PICKING_INLINE void keepNotNegative(Floats value, float step, Spans& spans)
{
  const Floats zero_at = -value / step;
  if (step > 0)
    spans.first = spans.first < zero_at ? zero_at : spans.first;
  else if (step < 0)
    spans.last = zero_at < spans.last ? zero_at : spans.last;
  else
    spans.last = value < 0 ? Floats{} - 1 : spans.last;
}

/// The least integers not below some numbers, which are not negative.
PPF_BIN_PICKING_INLINE Integers ceiled(Floats numbers)
{
  const Integers whole = __builtin_convertvector(numbers, Integers);
  return whole - (__builtin_convertvector(whole, Floats) < numbers);  // true is -1
}

/// Draws the pixels begin to end - 1 of a row; 1/z grows by a constant from pixel to pixel.
PPF_BIN_PICKING_INLINE void drawSpan(int begin, int end, float inverse_z0, float step_z,
                                     std::uint32_t index, float* __restrict inverse_z,
                                     std::uint32_t* __restrict triangle)
{
  for (int k = begin; k < end; ++k)
  {
    const float here = inverse_z0 + static_cast<float>(k) * step_z;
    const bool is_nearer = here > inverse_z[k];
    inverse_z[k] = is_nearer ? here : inverse_z[k];
    triangle[k] = is_nearer ? index : triangle[k];
  }
}

/// 1 where the surface may end between two pixels beside each other, else 0.
PPF_BIN_PICKING_INLINE std::int32_t mayEnd(float here_m, float next_m, float fall_m)
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
  if (u1 < u0) return;
  const float scale = 1.0F / area;
  // Weights of b and c grow by a constant from pixel to pixel; so does 1/z.
  const float step_b = (c.v - a.v) * scale, step_c = -(b.v - a.v) * scale;
  const float step_z = step_b * (b.inverse_z - a.inverse_z) + step_c * (c.inverse_z - a.inverse_z);
  const float du = static_cast<float>(u0) - a.u;
  for (int v = v0; v <= v1; v += kLanes)
  {
    const Floats dv = static_cast<float>(v) + __builtin_convertvector(kLaneNumbers, Floats) - a.v;
    const Floats weight_b = du * step_b - dv * (c.u - a.u) * scale;
    const Floats weight_c = du * step_c + dv * (b.u - a.u) * scale;
    Spans spans{Floats{}, Floats{} + static_cast<float>(u1 - u0)};
    keepNotNegative(weight_b, step_b, spans);
    keepNotNegative(weight_c, step_c, spans);
    keepNotNegative(1 - weight_b - weight_c, -step_b - step_c, spans);
    const Floats inverse_z0 = a.inverse_z + weight_b * (b.inverse_z - a.inverse_z) +
                              weight_c * (c.inverse_z - a.inverse_z);
    const Integers seen = spans.first <= spans.last;
    std::int32_t begins[kLanes], ends[kLanes];
    store(seen & ceiled(spans.first), begins);
    store(seen & (__builtin_convertvector(spans.last, Integers) + 1), ends);
    const int rows = std::min(kLanes, v1 - v + 1);
    for (int lane = 0; lane < rows; ++lane)
    {
      if (begins[lane] >= ends[lane]) continue;
      const std::ptrdiff_t start =
          static_cast<std::ptrdiff_t>(v + lane - window.top) * window.width + (u0 - window.left);
      drawSpan(begins[lane], ends[lane], inverse_z0[lane], step_z, index, window.inverse_z + start,
               window.triangle + start);
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

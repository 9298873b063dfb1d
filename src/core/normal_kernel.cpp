#include "ppf_bin_picking/core/normal_kernel.hpp"

#include "instruction_sets.hpp"
#include "lanes.hpp"

#include <algorithm>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
static_assert(kPlaneLanes == kLanes);

constexpr float kLeastSpread = 1e-3F;  // determinant a pixel below which a window is a line

struct Planes
{
  Floats a, b, c;
};

/// Sums over a window of the measured pixels that fit.
struct Moments
{
  Floats n{}, u{}, v{}, uu{}, uv{}, vv{}, z{}, uz{}, vz{};

  /// Adds the sums of a row: pixels, du, du^2, 1/z and du/z.
  void addRow(float dv, Floats count, Floats du, Floats dudu, Floats inverse, Floats du_inverse)
  {
    n += count, u += du, uu += dudu, z += inverse, uz += du_inverse;
    v += dv * count, uv += dv * du, vv += dv * dv * count, vz += dv * inverse;
  }

  /// The least squares' plane by Cramer's rule; none where the pixels are too few or on a line.
  Planes solve(float least_pixels) const
  {
    const Floats m0 = vv * n - v * v, m1 = uv * n - v * u, m2 = uv * v - vv * u;
    const Floats determinant = uu * m0 - uv * m1 + u * m2;
    const Integers solvable = (n >= least_pixels) & (determinant > kLeastSpread * n);
    const Floats scale = where(solvable, 1.0F / (solvable ? determinant : Floats{} + 1.0F));
    const Floats m3 = uu * n - u * u, m4 = uu * v - uv * u, m5 = uu * vv - uv * uv;
    return {scale * (m0 * uz - m1 * vz + m2 * z), scale * (m3 * vz - m1 * uz - m4 * z),
            scale * (m2 * uz - m4 * vz + m5 * z)};
  }
};

/// Fits anew to the pixels within a gate of planes.
inline Planes fitNear(const PaddedDepth& image, int radius_px, float gate_m, float least_pixels,
                      int u, int v, const Planes& near)
{
  Moments moments;
  for (int dv = -radius_px; dv <= radius_px; ++dv)
  {
    const std::size_t row = image.index(u, v + dv);
    const Floats row_plane = near.c + static_cast<float>(dv) * near.b;
    Floats count{}, sum_u{}, sum_uu{}, sum_z{}, sum_uz{};
    for (int du = -radius_px; du <= radius_px; ++du)
    {
      const auto step = static_cast<float>(du);
      const std::size_t pixel = row + static_cast<std::size_t>(du);
      const Floats z = load(&image.depth_m[pixel]), inverse = load(&image.inverse_m[pixel]);
      const Floats expected =
          row_plane + step * near.a;  // 1/z; |z - 1/e| < g where |z e - 1| < g e
      const Integers fits = (z > 0) & (magnitude(z * expected - 1.0F) < gate_m * expected);
      const Floats one = where(fits, Floats{} + 1.0F), taken = where(fits, inverse);
      count += one, sum_u += step * one, sum_uu += step * step * one;
      sum_z += taken, sum_uz += step * taken;
    }
    moments.addRow(static_cast<float>(dv), count, sum_u, sum_uu, sum_z, sum_uz);
  }
  return moments.solve(least_pixels);
}
}  // namespace

PaddedDepth::PaddedDepth(const float* given_m, int width, int height, int margin_px)
    : stride(width + kPlaneLanes + 2 * margin_px),
      margin(margin_px),
      depth_m(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2 * margin_px)),
      inverse_m(depth_m.size())
{
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
    {
      const float z = given_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(u)];
      depth_m[index(u, v)] = z;
      inverse_m[index(u, v)] = z > 0 ? 1.0F / z : 0.0F;
    }
}

PPF_BIN_PICKING_CLONES
void fitPlanes(const PaddedDepth& image, const PlaneFit& fit, int u, int v, PlaneLanes& planes)
{
  const Planes level{Floats{}, Floats{}, load(&image.inverse_m[image.index(u, v)])};
  const Planes first = fitNear(image, fit.radius_px, fit.gate_m, fit.least_pixels, u, v, level);
  const Planes second =
      fitNear(image, fit.radius_px, fit.second_gate_m, fit.least_pixels, u, v, first);
  std::memcpy(planes.a, &second.a, sizeof(planes.a));
  std::memcpy(planes.b, &second.b, sizeof(planes.b));
  std::memcpy(planes.c, &second.c, sizeof(planes.c));
}
}  // namespace ppf_bin_picking

/// @file What boundary voting does for every pair, on plain arrays. No Eigen here:
/// boundary_kernel.cpp is compiled for several instruction sets, and the processor's is chosen when
/// the program starts.
#pragma once

#include "ppf_bin_picking/core/pair_kernel.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Boundary points [m] with normals and outward directions, one array a coordinate.
struct BoundaryArrays
{
  PointArrays points;
  std::vector<float> ox, oy, oz;

  std::size_t size() const { return points.size(); }
  void resize(std::size_t count)
  {
    points.resize(count);
    for (std::vector<float>* array : {&ox, &oy, &oz})
      array->resize(count);
  }
  /// Sets a boundary point from its coordinates.
  void set(std::size_t i, const float* point, const float* normal, const float* outward)
  {
    points.set(i, point, normal);
    ox[i] = outward[0], oy[i] = outward[1], oz[i] = outward[2];
  }
};

/// The first boundary point of pairs [m], and its frame: normal, outward, their cross product.
struct BoundaryReference
{
  float p[3];
  float axes[3][3];
};

/// How pairs are rounded to keys: cells of the second point's place in the first one's frame.
struct BoundarySteps
{
  float inverse_cell;  ///< [1/m]
  float shortest_m;
  float longest_m;
  std::int32_t half_cells;  ///< From the middle to either end.
};

constexpr std::int32_t kBoundaryAxes = 6;  ///< Both ways along each axis.

/// Which of kBoundaryAxes a direction is nearest to; of equal ones the first axis.
inline std::int32_t nearestAxis(float x, float y, float z)
{
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const std::int32_t along_x = x < 0 ? 1 : 0;
  const std::int32_t along_y = y < 0 ? 3 : 2;
  const std::int32_t along_z = z < 0 ? 5 : 4;
  const std::int32_t of_two = ay > ax ? along_y : along_x;
  const bool is_along_z = (az > ax) & (az > ay);
  return is_along_z ? along_z : of_two;
}

/// The key of a pair: place, normal and outward direction of the second point, seen from the first.
/// kNoKey for pairs that are too long, or too short to tell anything.
inline std::uint32_t boundaryKeyOf(const BoundarySteps& steps, const BoundaryReference& first,
                                   float x, float y, float z, float nx, float ny, float nz,
                                   float ox, float oy, float oz)
{
  const float dx = x - first.p[0], dy = y - first.p[1], dz = z - first.p[2];
  const float squared = dot3(dx, dy, dz, dx, dy, dz);
  const auto& axes = first.axes;
  const auto along = [&](int k, float a, float b, float c)
  { return dot3(axes[k][0], axes[k][1], axes[k][2], a, b, c); };
  const auto cell = [&](int k)
  {
    const float place = along(k, dx, dy, dz) * steps.inverse_cell;
    return static_cast<std::int32_t>(place + (static_cast<float>(steps.half_cells) + 0.5F));
  };
  const std::int32_t cells = 2 * steps.half_cells + 1;
  std::int32_t key = (cell(0) * cells + cell(1)) * cells + cell(2);
  key = key * kBoundaryAxes +
        nearestAxis(along(0, nx, ny, nz), along(1, nx, ny, nz), along(2, nx, ny, nz));
  key = key * kBoundaryAxes +
        nearestAxis(along(0, ox, oy, oz), along(1, ox, oy, oz), along(2, ox, oy, oz));
  const bool is_pair = (squared >= steps.shortest_m * steps.shortest_m) &
                       (squared <= steps.longest_m * steps.longest_m);
  return is_pair ? static_cast<std::uint32_t>(key) : kNoKey;
}

/// Keys of the pairs of a reference with each of some boundary points.
/// @param keys  One a point.
void boundaryKeys(const BoundaryArrays& boundary, const BoundaryReference& reference,
                  const BoundarySteps& steps, std::uint32_t* keys);
}  // namespace ppf_bin_picking

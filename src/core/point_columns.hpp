/// @file Points as arrays that the compiler may take as not overlapping; private to the core, for
/// its kernels.
#pragma once

#include "ppf_bin_picking/core/pair_kernel.hpp"

namespace ppf_bin_picking
{
struct PointColumns
{
  explicit PointColumns(const PointArrays& points)
      : x(points.x.data()),
        y(points.y.data()),
        z(points.z.data()),
        nx(points.nx.data()),
        ny(points.ny.data()),
        nz(points.nz.data())
  {
  }

  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict z;
  const float* __restrict nx;
  const float* __restrict ny;
  const float* __restrict nz;
};
}  // namespace ppf_bin_picking

/// @file Some floats that are worked on together; private to the core, for its kernels. Functions
/// with lanes are inlined into those that are compiled for several instruction sets.
#pragma once

#include "instruction_sets.hpp"

#include <cstdint>
#include <cstring>

namespace ppf_bin_picking
{
constexpr int kLanes = 8;

using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
using Integers = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

constexpr Integers kLaneNumbers = {0, 1, 2, 3, 4, 5, 6, 7};

PPF_BIN_PICKING_INLINE Floats load(const float* from)
{
  Floats values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}

PPF_BIN_PICKING_INLINE void store(Integers values, std::int32_t* to)
{
  std::memcpy(to, &values, sizeof(values));
}

/// The values where the mask is set, 0 elsewhere.
PPF_BIN_PICKING_INLINE Floats where(Integers mask, Floats values)
{
  return mask ? values : Floats{};
}

PPF_BIN_PICKING_INLINE Floats magnitude(Floats values)
{
  return values < 0 ? -values : values;
}
}  // namespace ppf_bin_picking

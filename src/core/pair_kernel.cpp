#include "ppf_bin_picking/core/pair_kernel.hpp"

#include "instruction_sets.hpp"
#include "point_columns.hpp"

namespace ppf_bin_picking
{
namespace
{
PPF_BIN_PICKING_CLONES
void keysOf(const PointColumns& columns, std::size_t count, const PairReference& given,
            const KeySteps& given_steps, std::uint32_t* __restrict keys,
            std::uint32_t* __restrict alphas)
{
  const PointColumns at = columns;
  const PairReference r = given;
  const KeySteps steps = given_steps;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float dx = at.x[i] - r.p[0], dy = at.y[i] - r.p[1], dz = at.z[i] - r.p[2];
    const float distance_m = std::sqrt(dot3(dx, dy, dz, dx, dy, dz));
    const float inverse = 1.0F / (distance_m > 0 ? distance_m : 1.0F);
    const float n1_d = dot3(r.n[0], r.n[1], r.n[2], dx, dy, dz) * inverse;
    const float n2_d = dot3(at.nx[i], at.ny[i], at.nz[i], dx, dy, dz) * inverse;
    const float n1_n2 = dot3(r.n[0], r.n[1], r.n[2], at.nx[i], at.ny[i], at.nz[i]);
    const std::uint32_t key =
        keyOf(steps, distance_m, arcCosine(n1_d), arcCosine(n2_d), arcCosine(n1_n2));
    const bool is_pair = (distance_m > 0) & (distance_m <= steps.diameter_m);
    keys[i] = is_pair ? key : kNoKey;
    const float y = dot3(r.y_axis[0], r.y_axis[1], r.y_axis[2], dx, dy, dz);
    const float z = dot3(r.z_axis[0], r.z_axis[1], r.z_axis[2], dx, dy, dz);
    alphas[i] = alphaOf(y, z);
  }
}
}  // namespace

void pairKeys(const PointArrays& points, const PairReference& reference, const KeySteps& steps,
              std::uint32_t* keys, std::uint32_t* alphas)
{
  keysOf(PointColumns(points), points.size(), reference, steps, keys, alphas);
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/boundary_kernel.hpp"

#include "instruction_sets.hpp"

namespace ppf_bin_picking
{
namespace
{
/// Arrays that the compiler may take as not overlapping.
struct Columns
{
  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict z;
  const float* __restrict nx;
  const float* __restrict ny;
  const float* __restrict nz;
  const float* __restrict ox;
  const float* __restrict oy;
  const float* __restrict oz;
};

PPF_BIN_PICKING_CLONES
void keysOf(const Columns& columns, std::size_t count, const BoundaryReference& given,
            const BoundarySteps& given_steps, std::uint32_t* __restrict keys)
{
  const Columns at = columns;
  const BoundaryReference reference = given;
  const BoundarySteps steps = given_steps;
  for (std::size_t i = 0; i < count; ++i)
    keys[i] = boundaryKeyOf(steps, reference, at.x[i], at.y[i], at.z[i], at.nx[i], at.ny[i],
                            at.nz[i], at.ox[i], at.oy[i], at.oz[i]);
}
}  // namespace

void boundaryKeys(const BoundaryArrays& boundary, const BoundaryReference& reference,
                  const BoundarySteps& steps, std::uint32_t* keys)
{
  const PointArrays& points = boundary.points;
  const Columns columns{points.x.data(),    points.y.data(),    points.z.data(),
                        points.nx.data(),   points.ny.data(),   points.nz.data(),
                        boundary.ox.data(), boundary.oy.data(), boundary.oz.data()};
  keysOf(columns, boundary.size(), reference, steps, keys);
}

}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/boundary_kernel.hpp"

#include "instruction_sets.hpp"
#include "point_columns.hpp"

namespace ppf_bin_picking
{
namespace
{
/// The same for boundary points.
struct BoundaryColumns : PointColumns
{
  explicit BoundaryColumns(const BoundaryArrays& boundary)
      : PointColumns(boundary.points),
        ox(boundary.ox.data()),
        oy(boundary.oy.data()),
        oz(boundary.oz.data())
  {
  }

  const float* __restrict ox;
  const float* __restrict oy;
  const float* __restrict oz;
};

PPF_BIN_PICKING_CLONES
void keysOf(const BoundaryColumns& columns, std::size_t count, const BoundaryReference& given,
            const BoundarySteps& given_steps, std::uint32_t* __restrict keys)
{
  const BoundaryColumns at = columns;
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
  keysOf(BoundaryColumns(boundary), boundary.size(), reference, steps, keys);
}
}  // namespace ppf_bin_picking

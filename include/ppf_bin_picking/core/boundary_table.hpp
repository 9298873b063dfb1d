/// @file Pairs of boundary points of a model, by how the second lies in the frame of the first.
#pragma once

#include "ppf_bin_picking/core/boundary.hpp"
#include "ppf_bin_picking/core/boundary_kernel.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/symmetry.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Boundary points of a part and the table of their pairs. Points are metres in the mesh's frame
/// shifted by -center.
struct BoundaryTable
{
  std::vector<BoundaryPoint> points;
  std::vector<std::uint32_t> offsets;  ///< Entries of key k: [offsets[k], offsets[k + 1]).
  std::vector<std::uint32_t> entries;  ///< First points of the pairs, each once a key.
};

/// Numbers the ways in which one boundary point can lie in the frame of another: cells of its
/// position, and the axes of the frame that its normal and its outward direction are nearest to.
class BoundaryQuantizer
{
public:
  /// @param diameter_m  Longest pair; longer ones have no key.
  explicit BoundaryQuantizer(float diameter_m);

  /// Keys run from 0 to keyCount() - 1.
  static std::uint32_t keyCount();

  /// @return kNoKey for pairs that are too long, or too short to tell anything.
  std::uint32_t key(const BoundaryReference& first, const BoundaryPoint& second) const;

  /// The same for boundaryKeys.
  const BoundarySteps& steps() const { return steps_; }

private:
  BoundarySteps steps_;
};

/// The first point of pairs, for BoundaryQuantizer::key and boundaryKeys.
BoundaryReference boundaryReference(const BoundaryPoint& first);

/// The table of the pairs that some viewpoint around the part sees together. Of first points that
/// the discrete symmetries lay onto each other one is enough.
/// @param center  Of the part, mesh frame [m].
BoundaryTable buildBoundaryTable(const RenderableMesh& mesh, const Eigen::Vector3f& center,
                                 float diameter_m, const SymmetryGroup& symmetries);

/// Least fall beyond a boundary point [m], for the model and for the scene.
float boundaryJump(float diameter_m);

/// Cell of boundary points that become one [m], for the model and for the scene.
float boundarySpacing(float diameter_m);
}  // namespace ppf_bin_picking

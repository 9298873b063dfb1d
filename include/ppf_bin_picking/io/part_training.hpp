/// @file From a part's mesh to its model.
#pragma once

#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include "ppf_bin_picking/io/part_io.hpp"

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// A trained model, and what its training found.
struct TrainedPart
{
  PpfModel model;
  /// One line each: what was left of the mesh, if it was simplified; where the symmetries are from
  /// and what they are.
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< What will keep the part from being picked.
};

/// Trains the model of a part from its simplified mesh, see simplifiedMesh(). Its symmetries are
/// those of that mesh, too.
/// @param mesh  Of the part, as loaded [m].
/// @throw InputError if the mesh has no surface, is less than half a millimetre across, or has not
/// a
///        symmetry that the part file states.
/// @throw std::invalid_argument if the parameters do not fit the mesh.
TrainedPart trainPart(const PartDescription& part, const TriangleMesh& mesh,
                      const ModelParameters& parameters);
}  // namespace ppf_bin_picking

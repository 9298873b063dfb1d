#include "ppf_bin_picking/io/part_training.hpp"

#include "ppf_bin_picking/io/mesh_simplification.hpp"

namespace ppf_bin_picking
{
TrainedPart trainPart(const PartDescription& part, const TriangleMesh& mesh,
                      const ModelParameters& parameters)
{
  const TriangleMesh simple = simplifiedMesh(mesh);
  const PartSymmetries symmetries = symmetriesOf(part, simple);
  TrainedPart trained{PpfModel::train(simple, symmetries.group, parameters), {}, {}};
  if (simple.triangles.size() < mesh.triangles.size())
    trained.notes.push_back("mesh simplified from " + std::to_string(mesh.triangles.size()) +
                            " to " + std::to_string(simple.triangles.size()) + " triangles");
  trained.notes.push_back(symmetries.summary);
  if (!symmetries.warning.empty()) trained.warnings.push_back(symmetries.warning);
  return trained;
}
}  // namespace ppf_bin_picking

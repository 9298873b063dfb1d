#include "ppf_bin_picking/io/part_training.hpp"

#include "ppf_bin_picking/core/surface_sampling.hpp"

#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/mesh_simplification.hpp"

#include <sstream>

namespace ppf_bin_picking
{
namespace
{
constexpr double kSmallestPart_m = 0.001;
constexpr double kLargestPart_m = 5;
constexpr double kSmallestTrained_m = 0.0005;  // views of smaller ones would show nothing

/// Empty for a part of a size that lies in bins.
std::string sizeWarning(const PartDescription& part, double diameter_m)
{
  if (diameter_m >= kSmallestPart_m && diameter_m <= kLargestPart_m) return "";
  std::ostringstream text;
  text.precision(3);
  text << part.source << ": the part is " << diameter_m << " m across: check its unit ("
       << (diameter_m < kSmallestPart_m ? "mm for m" : "m for mm") << ")";
  return text.str();
}
}  // namespace

TrainedPart trainPart(const PartDescription& part, const TriangleMesh& mesh,
                      const ModelParameters& parameters)
{
  const double diameter_m = meshDiameter(mesh);
  const std::string size_warning = sizeWarning(part, diameter_m);
  if (diameter_m > 0 && diameter_m < kSmallestTrained_m) throw InputError(size_warning);
  const TriangleMesh simple = simplifiedMesh(mesh);
  const PartSymmetries symmetries = symmetriesOf(part, simple);
  TrainedPart trained{PpfModel::train(simple, symmetries.group, parameters), {}, {}};
  if (simple.triangles.size() < mesh.triangles.size())
    trained.notes.push_back("mesh simplified from " + std::to_string(mesh.triangles.size()) +
                            " to " + std::to_string(simple.triangles.size()) + " triangles");
  trained.notes.push_back(symmetries.summary);
  for (const std::string& warning : {symmetries.warning, size_warning})
    if (!warning.empty()) trained.warnings.push_back(warning);
  return trained;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/ppf_model.hpp"

#include "ppf_bin_picking/core/look_alikes.hpp"
#include "ppf_bin_picking/core/orbits.hpp"
#include "ppf_bin_picking/core/ppf.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMaxPoints = 65535;  // an entry holds the reference in 16 bits
constexpr float kSamplesPerStep = 5.0F;    // dense samples along one sampling step

void requireThat(bool condition, const char* problem)
{
  if (!condition) throw std::invalid_argument(problem);
}

/// Calls visit(key, entry) for all ordered pairs that the quantizer covers whose first point is a
/// reference point.
template <class Visitor>
void forEachPair(const PpfModelData& data, std::size_t references,
                 const FeatureQuantizer& quantizer, Visitor visit)
{
  PointArrays points;
  points.resize(data.points.size());
  for (std::size_t j = 0; j < data.points.size(); ++j)
    points.set(j, data.points[j].data(), data.normals[j].data());
  std::vector<std::uint32_t> keys(points.size()), alphas(points.size());
  for (std::size_t r = 0; r < references; ++r)
  {
    pairKeys(points, pairReference(data.points[r], data.normals[r]), quantizer.steps(), keys.data(),
             alphas.data());
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != r && keys[j] != kNoKey)
        visit(keys[j], static_cast<std::uint32_t>(r) << 16 | alphas[j]);
  }
}

/// Fills the table: counts the entries of each key, then puts them in place.
void buildTable(std::size_t references, PpfModelData& data)
{
  const FeatureQuantizer quantizer(data.parameters, data.diameter_m);
  data.offsets.assign(quantizer.keyCount() + 1, 0);
  forEachPair(data, references, quantizer,
              [&](std::uint32_t key, std::uint32_t) { ++data.offsets[key + 1]; });
  for (std::size_t k = 1; k < data.offsets.size(); ++k)
    data.offsets[k] += data.offsets[k - 1];
  data.entries.resize(data.offsets.back());
  std::vector<std::uint32_t> next(data.offsets.begin(), data.offsets.end() - 1);
  forEachPair(data, references, quantizer,
              [&](std::uint32_t key, std::uint32_t entry) { data.entries[next[key]++] = entry; });
}

void checkMesh(const TriangleMesh& mesh)
{
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    requireThat(vertex.allFinite(), "a vertex is not finite");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      requireThat(index < mesh.vertices.size(), "a triangle names a vertex that does not exist");
}

void checkTable(const PpfModelData& data)
{
  const FeatureQuantizer quantizer(data.parameters, data.diameter_m);
  requireThat(data.offsets.size() == quantizer.keyCount() + 1U,
              "the table's size does not fit its parameters");
  requireThat(data.offsets.front() == 0 && data.offsets.back() == data.entries.size(),
              "the table's offsets do not fit its entries");
  for (std::size_t k = 1; k < data.offsets.size(); ++k)
    requireThat(data.offsets[k - 1] <= data.offsets[k], "the table's offsets do not ascend");
  for (const std::uint32_t entry : data.entries)
    requireThat((entry >> 16) < data.points.size(), "an entry names a point that does not exist");
}

void checkBoundary(const BoundaryTable& table)
{
  requireThat(table.offsets.size() == BoundaryQuantizer::keyCount() + 1U,
              "the boundary table's size is wrong");
  requireThat(table.offsets.front() == 0 && table.offsets.back() == table.entries.size(),
              "the boundary table's offsets do not fit its entries");
  for (std::size_t k = 1; k < table.offsets.size(); ++k)
    requireThat(table.offsets[k - 1] <= table.offsets[k],
                "the boundary table's offsets do not ascend");
  for (const std::uint32_t entry : table.entries)
    requireThat(entry < table.points.size(),
                "an entry of the boundary table names a point that does not exist");
  for (const BoundaryPoint& boundary : table.points)
    requireThat(
        boundary.point.allFinite() && boundary.normal.allFinite() && boundary.outward.allFinite(),
        "a boundary point is not finite");
}

/// The data as they are. @throw std::invalid_argument naming a contradiction.
PpfModelData checked(PpfModelData data)
{
  DetectorConfig config;
  config.model = data.parameters;
  const std::vector<std::string> problems = config.problems();
  if (!problems.empty()) throw std::invalid_argument(problems.front());
  requireThat(std::isfinite(data.diameter_m) && data.diameter_m > 0,
              "the diameter is not above zero");
  requireThat(data.center.allFinite(), "the centre is not finite");
  requireThat(!data.points.empty() && data.points.size() <= kMaxPoints,
              "the number of points is out of range");
  requireThat(data.points.size() == data.normals.size(), "points and normals differ in number");
  const auto finite = [](const Eigen::Vector3f& v) { return v.allFinite(); };
  requireThat(std::all_of(data.points.begin(), data.points.end(), finite) &&
                  std::all_of(data.normals.begin(), data.normals.end(), finite),
              "a point or normal is not finite");
  checkMesh(data.mesh);
  checkTable(data);
  checkBoundary(data.boundary);
  return data;
}
}  // namespace

PpfModel PpfModel::train(const TriangleMesh& mesh, const SymmetryGroup& symmetries,
                         const ModelParameters& parameters)
{
  DetectorConfig config;
  config.model = parameters;
  const std::vector<std::string> problems = config.problems();
  if (!problems.empty()) throw std::invalid_argument(problems.front());
  checkMesh(mesh);

  PpfModelData data;
  data.parameters = parameters;
  data.mesh = mesh;
  data.symmetries_discrete = symmetries.generators();
  data.symmetries_continuous = symmetries.revolutionAxes();
  data.center = boundingSphereCenter(mesh);
  data.diameter_m = meshDiameter(mesh);
  requireThat(data.diameter_m > 0,
              "the mesh has no surface: give one with at least a triangle of some area");
  const float step_m = static_cast<float>(parameters.step_rel) * data.diameter_m;
  OrientedPoints surface = sampleVisibleSurface(data.mesh, step_m / kSamplesPerStep);
  for (Eigen::Vector3f& point : surface.points)
    point -= data.center;
  OrientedPoints samples = thinOut(surface, step_m);
  requireThat(!samples.points.empty(),
              "the mesh has no surface: give one with at least a triangle of some area");
  requireThat(samples.size() <= kMaxPoints, "the model has more than 65535 points: raise step_rel");
  const std::size_t references =
      moveRepresentativesToFront(symmetries, data.center, step_m, samples);
  data.points = std::move(samples.points);
  data.normals = std::move(samples.normals);
  buildTable(references, data);
  data.boundary =
      buildBoundaryTable(RenderableMesh(data.mesh), data.center, data.diameter_m, symmetries);
  return PpfModel(std::move(data));
}

PpfModel::PpfModel(PpfModelData data)
    : data_(checked(std::move(data))),
      symmetries_(data_.symmetries_discrete, data_.symmetries_continuous),
      renderable_(data_.mesh),
      look_alikes_(lookAlikeTurns(data_, symmetries_))
{
  for (const std::uint32_t entry : data_.entries)
    references_ = std::max<std::size_t>(references_, (entry >> 16) + 1);
}
}  // namespace ppf_bin_picking

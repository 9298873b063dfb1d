#include "ppf_bin_picking/io/mesh_simplification.hpp"

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/surface_sampling.hpp"

#include <vtkCellArray.h>
#include <vtkCellLocator.h>
#include <vtkDecimatePro.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kManyTriangles = 8000;   // up to these a mesh is used as it is
constexpr std::size_t kFewTriangles = 2000;    // these are quick
constexpr std::size_t kMostTriangles = 60000;  // that a simplified mesh is made of
constexpr float kToleranceRel = 0.001F;        // of the diameter: a tenth of a pixel, about
constexpr float kSpacingRel = 0.01F;           // of the samples between which distances are taken
constexpr float kVtkDiameter = 100;  // in metres, VTK takes a small triangle for one without area
constexpr double kFlatRel = 1e-6;    // of the diameter: flat but for rounding

vtkSmartPointer<vtkPolyData> toVtk(const TriangleMesh& mesh, float scale)
{
  const auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    points->InsertNextPoint(Eigen::Vector3f(scale * vertex).data());
  const auto triangles = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& triangle : mesh.triangles)
  {
    const std::array<vtkIdType, 3> corners = {triangle[0], triangle[1], triangle[2]};
    triangles->InsertNextCell(3, corners.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/// The triangles of a surface and the vertices that they use.
TriangleMesh fromVtk(vtkPolyData& surface, float scale)
{
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_of_point(static_cast<std::size_t>(surface.GetNumberOfPoints()),
                                             kUnused);
  const auto cell = vtkSmartPointer<vtkGenericCell>::New();
  for (vtkIdType i = 0; i < surface.GetNumberOfCells(); ++i)
  {
    surface.GetCell(i, cell);
    std::array<std::uint32_t, 3> triangle;
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType point = cell->GetPointId(k);
      std::uint32_t& vertex = vertex_of_point[static_cast<std::size_t>(point)];
      if (vertex == kUnused)
      {
        vertex = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.emplace_back(
            (Eigen::Map<Eigen::Vector3d>(surface.GetPoint(point)) / scale).cast<float>());
      }
      triangle[static_cast<std::size_t>(k)] = vertex;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// Takes the vertices away whose surroundings are flat. Edges between such are free, and collapsing
/// them by the hundred thousand leaves vertices with very many others around, which takes long.
vtkSmartPointer<vtkPolyData> withoutFlatVertices(vtkPolyData& surface)
{
  const auto decimation = vtkSmartPointer<vtkDecimatePro>::New();
  decimation->SetInputData(&surface);
  decimation->PreserveTopologyOn();
  decimation->SetErrorIsAbsolute(1);
  decimation->SetAbsoluteError(std::pow(kVtkDiameter * kFlatRel, 2));  // VTK's is squared
  decimation->SetTargetReduction(1);
  decimation->Update();
  return decimation->GetOutput();
}

vtkSmartPointer<vtkPolyData> collapsed(vtkPolyData& surface, std::size_t max_triangles)
{
  const auto triangles = static_cast<double>(surface.GetNumberOfCells());
  const auto decimation = vtkSmartPointer<vtkQuadricDecimation>::New();
  decimation->SetInputData(&surface);
  decimation->SetTargetReduction(std::max(0.0, 1 - static_cast<double>(max_triangles) / triangles));
  decimation->Update();
  return decimation->GetOutput();
}

bool isClosed(const TriangleMesh& mesh)
{
  return RenderableMesh(mesh).closed;
}

/// What the simplified meshes are made of: a surface of no more than 60000 triangles, whose edges
/// are soon sorted, closed if the given one is.
vtkSmartPointer<vtkPolyData> quickStart(vtkPolyData& surface, bool is_closed)
{
  const auto stays = [&](vtkPolyData& other) { return isClosed(fromVtk(other, 1)) == is_closed; };
  vtkSmartPointer<vtkPolyData> bent = withoutFlatVertices(surface);
  const bool few_are_flat = bent->GetNumberOfCells() > surface.GetNumberOfCells() / 2;
  if (few_are_flat || !stays(*bent)) bent = &surface;
  vtkSmartPointer<vtkPolyData> start;
  for (std::size_t count = kMostTriangles; count > kManyTriangles; count = count * 2 / 3)
  {
    start = collapsed(*bent, count);
    if (stays(*start)) break;
  }
  return start;
}

/// A mesh that others are compared with. It has triangles.
class Surface
{
public:
  Surface(const TriangleMesh& mesh, float spacing_m)
      : samples_(sampleTriangles(mesh, spacing_m)), surface_(toVtk(mesh, 1))
  {
    locator_->SetDataSet(surface_);
    locator_->BuildLocator();
  }

  /// True if no sample is farther from the other surface.
  bool isWithin(double distance_m, Surface& other) const
  {
    return std::all_of(samples_.begin(), samples_.end(),
                       [&](const MeshSample& sample)
                       { return other.distanceTo(sample.point) <= distance_m; });
  }

private:
  double distanceTo(const Eigen::Vector3f& point)
  {
    std::array<double, 3> from = {point.x(), point.y(), point.z()}, foot{};
    vtkIdType triangle = 0;
    int part = 0;
    double squared_m2 = std::numeric_limits<double>::infinity();
    locator_->FindClosestPoint(from.data(), foot.data(), cell_, triangle, part, squared_m2);
    return std::sqrt(squared_m2);
  }

  std::vector<MeshSample> samples_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkCellLocator> locator_ = vtkSmartPointer<vtkCellLocator>::New();
  vtkSmartPointer<vtkGenericCell> cell_ = vtkSmartPointer<vtkGenericCell>::New();
};
}  // namespace

TriangleMesh decimated(const TriangleMesh& mesh, std::size_t max_triangles)
{
  if (mesh.triangles.size() <= max_triangles) return mesh;
  const float diameter_m = meshDiameter(mesh);
  if (!(diameter_m > 0)) return mesh;
  const float scale = kVtkDiameter / diameter_m;
  return fromVtk(*collapsed(*toVtk(mesh, scale), max_triangles), scale);
}

TriangleMesh simplifiedMesh(const TriangleMesh& mesh)
{
  if (mesh.triangles.size() <= kManyTriangles) return mesh;
  const float diameter_m = meshDiameter(mesh);
  if (!(diameter_m > 0)) return mesh;
  const float scale = kVtkDiameter / diameter_m;
  const float spacing_m = kSpacingRel * diameter_m;
  const double tolerance_m = kToleranceRel * diameter_m;
  const bool is_closed = isClosed(mesh);
  Surface given(mesh, spacing_m);
  const vtkSmartPointer<vtkPolyData> start = quickStart(*toVtk(mesh, scale), is_closed);
  const auto made_of = static_cast<std::size_t>(start->GetNumberOfCells());
  const std::size_t most = mesh.triangles.size() * 2 / 3;
  std::size_t tried = 0;
  for (std::size_t count = kFewTriangles; count <= most && tried < made_of; count = count * 3 / 2)
  {
    tried = count;
    TriangleMesh simple = fromVtk(*collapsed(*start, count), scale);
    if (simple.triangles.empty() || simple.triangles.size() > most || isClosed(simple) != is_closed)
      continue;
    Surface surface(simple, spacing_m);
    if (given.isWithin(tolerance_m, surface) && surface.isWithin(tolerance_m, given)) return simple;
  }
  return mesh;
}
}  // namespace ppf_bin_picking

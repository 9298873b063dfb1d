#include "ppf_bin_picking/core/boundary_table.hpp"

#include "ppf_bin_picking/core/orbits.hpp"
#include "ppf_bin_picking/core/viewpoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr int kViews = 240;
constexpr float kPixelsPerDiameter = 100.0F;  // as the detector's images have it
constexpr float kViewDistanceRel = 8.0F;      // of the diameter
constexpr float kJumpRel = 0.03F;             // of the diameter
constexpr float kSpacingRel = 0.04F;          // of the diameter
constexpr float kCellRel = 0.08F;             // of the diameter
constexpr float kShortestRel = 0.1F;          // of the diameter
constexpr float kTieRel = 1e-4F;              // of the diameter
constexpr int kHalfCells = 13;                // 1 / kCellRel, rounded
constexpr std::uint32_t kCells = 2 * kHalfCells + 1;

/// The part alone before nothing, as an image of the detector's resolution.
RangeImage imageOfView(const RenderableMesh& mesh, const Eigen::Isometry3f& T_camera_model,
                       float diameter_m, RenderedPart& view)
{
  RangeImage image;
  const auto side_px = static_cast<int>(1.3F * kPixelsPerDiameter);
  const float focal_px = kPixelsPerDiameter * kViewDistanceRel;
  const auto middle_px = 0.5F * static_cast<float>(side_px - 1);
  image.camera = {side_px, side_px, focal_px, focal_px, middle_px, middle_px};
  renderPart(mesh, T_camera_model, image.camera, view);
  const auto pixels = static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px);
  image.depth.assign(pixels, 2 * kViewDistanceRel * diameter_m);
  image.normals.assign(pixels, Eigen::Vector3f::Zero());
  image.in_roi.assign(pixels, 0);
  for (int row = 0; row < view.height; ++row)
    for (int column = 0; column < view.width; ++column)
    {
      const float z = view.depthAt(column, row);
      if (z == 0) continue;
      const std::size_t i = image.index(view.left + column, view.top + row);
      const Eigen::Vector3f& normal =
          view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
      image.depth[i] = z;
      image.in_roi[i] = 1;
      image.normals[i] =
          normal.dot(image.point(view.left + column, view.top + row)) > 0 ? -normal : normal;
    }
  return image;
}

/// Numbers boundary points so that those of one place and direction have one number.
class PointCollection
{
public:
  PointCollection(float cell_m, std::vector<BoundaryPoint>& points)
      : cell_m_(cell_m), points_(points)
  {
  }

  std::uint32_t numberOf(const BoundaryPoint& boundary)
  {
    const Eigen::Array3i cell = (boundary.point / cell_m_).array().floor().cast<int>();
    std::vector<std::uint32_t>& here = cells_[{cell.x(), cell.y(), cell.z()}];
    for (const std::uint32_t known : here)
      if (points_[known].normal.dot(boundary.normal) > kSameDirection &&
          points_[known].outward.dot(boundary.outward) > kSameDirection)
        return known;
    here.push_back(static_cast<std::uint32_t>(points_.size()));
    points_.push_back(boundary);
    return here.back();
  }

private:
  static constexpr float kSameDirection = 0.94F;  // cosine of 20 degrees
  float cell_m_;
  std::vector<BoundaryPoint>& points_;
  std::map<std::array<int, 3>, std::vector<std::uint32_t>> cells_;
};

/// The boundary points that each view shows, by number; fills `points`.
std::vector<std::vector<std::uint32_t>> pointsOfViews(const RenderableMesh& mesh,
                                                      const Eigen::Vector3f& center,
                                                      float diameter_m,
                                                      std::vector<BoundaryPoint>& points)
{
  PointCollection collection(boundarySpacing(diameter_m), points);
  std::vector<std::vector<std::uint32_t>> seen;
  RenderedPart view;
  for (const Eigen::Isometry3f& T_camera_model :
       viewpointsAround(center, kViewDistanceRel * diameter_m, kViews))
  {
    const RangeImage image = imageOfView(mesh, T_camera_model, diameter_m, view);
    const Eigen::Isometry3f T_model_camera = T_camera_model.inverse(Eigen::Isometry);
    std::vector<std::uint32_t> numbers;
    for (BoundaryPoint boundary : boundaryOf(image, boundaryJump(diameter_m), 1))
    {
      boundary.point = T_model_camera * boundary.point - center;
      boundary.normal = T_model_camera.linear() * boundary.normal;
      boundary.outward = T_model_camera.linear() * boundary.outward;
      numbers.push_back(collection.numberOf(boundary));
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    seen.push_back(std::move(numbers));
  }
  return seen;
}
}  // namespace

BoundaryQuantizer::BoundaryQuantizer(float diameter_m)
    : steps_{1 / (kCellRel * diameter_m), kShortestRel * diameter_m, diameter_m, kHalfCells}
{
}

std::uint32_t BoundaryQuantizer::keyCount()
{
  return kCells * kCells * kCells * kBoundaryAxes * kBoundaryAxes;
}

std::uint32_t BoundaryQuantizer::key(const BoundaryReference& first,
                                     const BoundaryPoint& second) const
{
  const Eigen::Vector3f &p = second.point, &n = second.normal, &o = second.outward;
  return boundaryKeyOf(steps_, first, p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), o.x(), o.y(),
                       o.z());
}

BoundaryReference boundaryReference(const BoundaryPoint& first)
{
  const Eigen::Matrix3f frame = first.frame();
  BoundaryReference reference;
  for (int k = 0; k < 3; ++k)
  {
    reference.p[k] = first.point[k];
    for (int c = 0; c < 3; ++c)
      reference.axes[k][c] = frame(c, k);
  }
  return reference;
}

BoundaryTable buildBoundaryTable(const RenderableMesh& mesh, const Eigen::Vector3f& center,
                                 float diameter_m, const SymmetryGroup& symmetries)
{
  BoundaryTable table;
  const std::vector<std::vector<std::uint32_t>> views =
      pointsOfViews(mesh, center, diameter_m, table.points);
  const BoundaryQuantizer quantizer(diameter_m);
  std::vector<Eigen::Vector3f> places;
  for (const BoundaryPoint& boundary : table.points)
    places.push_back(boundary.point);
  const std::vector<std::uint8_t> wanted =
      inFundamentalDomain(symmetries, center, kTieRel * diameter_m, places);
  std::vector<std::uint64_t> pairs;  // key << 32 | first point
  for (const std::vector<std::uint32_t>& seen : views)
    for (const std::uint32_t i : seen)
    {
      if (!wanted[i]) continue;
      const BoundaryReference first = boundaryReference(table.points[i]);
      for (const std::uint32_t j : seen)
      {
        const std::uint32_t key = quantizer.key(first, table.points[j]);
        if (key != kNoKey) pairs.push_back(std::uint64_t{key} << 32 | i);
      }
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  table.offsets.assign(BoundaryQuantizer::keyCount() + 1, 0);
  for (const std::uint64_t pair : pairs)
  {
    ++table.offsets[(pair >> 32) + 1];
    table.entries.push_back(static_cast<std::uint32_t>(pair));
  }
  for (std::size_t k = 1; k < table.offsets.size(); ++k)
    table.offsets[k] += table.offsets[k - 1];
  return table;
}

float boundaryJump(float diameter_m)
{
  return kJumpRel * diameter_m;
}

float boundarySpacing(float diameter_m)
{
  return kSpacingRel * diameter_m;
}
}  // namespace ppf_bin_picking

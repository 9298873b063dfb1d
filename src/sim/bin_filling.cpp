#include "ppf_bin_picking/sim/bin_filling.hpp"

#include "ppf_bin_picking/sim/random.hpp"
#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr double kCell_m = 0.0015;   // of the height maps
constexpr double kMargin_m = 0.001;  // between parts and walls
constexpr double kMaxLean_rad = 0.4;
constexpr int kOrientations = 8;  // tried for each part
constexpr int kPlaces = 16;       // tried for each orientation
constexpr double kNothing = -1;   // below every height

/// Heights [m] over cells; row by row along x.
struct HeightMap
{
  int columns = 0;
  int rows = 0;
  std::vector<double> heights;

  HeightMap(int columns_in, int rows_in, double height)
      : columns(columns_in),
        rows(rows_in),
        heights(static_cast<std::size_t>(columns) * rows, height)
  {
  }
  double& at(int column, int row)
  {
    return heights[static_cast<std::size_t>(row) * columns + column];
  }
  double at(int column, int row) const
  {
    return heights[static_cast<std::size_t>(row) * columns + column];
  }
};

/// A part as it is lowered: turned, its lowest point at height 0, seen from below and above.
struct TurnedPart
{
  Eigen::Isometry3d T_corner_part;  ///< Corner: the lowest x, y and z of the turned part.
  double center_height = 0;         ///< Of the centre of mass [m].
  HeightMap bottom;                 ///< Infinite where there is no part.
  HeightMap top;                    ///< kNothing where there is no part.
};

struct Place
{
  int column = 0;
  int row = 0;
  double lift = 0;  ///< Height of the part's lowest point [m].
};

Eigen::Vector3d centerOfMass(const TriangleMesh& part)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double volume = 0;
  for (const auto& triangle : part.triangles)
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = part.vertices[triangle[k]].cast<double>();
    volume += corners.determinant();
    sum += corners.determinant() * corners.rowwise().sum() / 4;
  }
  if (!(volume > 0))
    throw std::invalid_argument("the part has no volume: give a closed mesh wound outwards");
  return sum / volume;
}

/// Height of the centre above a table when the direction `down` of the part points at it.
double heightOverTable(const TriangleMesh& part, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& down)
{
  double reach = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : part.vertices)
    reach = std::max(reach, vertex.cast<double>().dot(down));
  return reach - center.dot(down);
}

/// An orientation in which the part rests on a table: it rolls from a random one until its centre
/// of mass cannot sink any more.
Eigen::Quaterniond restingOrientation(const TriangleMesh& part, const Eigen::Vector3d& center,
                                      Random& random)
{
  Eigen::Vector3d down = random.direction();
  double height = heightOverTable(part, center, down);
  for (double step_rad = 0.5; step_rad > 1e-4; step_rad *= 0.7)
  {
    for (int trial = 0; trial < 8; ++trial)
    {
      const Eigen::Vector3d other = (down + step_rad * random.direction()).normalized();
      const double other_height = heightOverTable(part, center, other);
      if (other_height >= height) continue;
      down = other;
      height = other_height;
    }
  }
  const Eigen::AngleAxisd turn(random.uniform(0, 2 * M_PI), Eigen::Vector3d::UnitZ());
  return turn * Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ());
}

TurnedPart turned(const TriangleMesh& part, const RayCaster& caster, const Eigen::Vector3d& center,
                  const Eigen::Quaterniond& rotation)
{
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3f& vertex : part.vertices)
    extent.extend(rotation * vertex.cast<double>());
  const int columns = static_cast<int>(std::ceil(extent.sizes().x() / kCell_m));
  const int rows = static_cast<int>(std::ceil(extent.sizes().y() / kCell_m));
  const double height = extent.sizes().z();
  TurnedPart result{Eigen::Translation3d(-extent.min()) * rotation,
                    (rotation * center).z() - extent.min().z(),
                    HeightMap(columns, rows, std::numeric_limits<double>::infinity()),
                    HeightMap(columns, rows, kNothing)};
  const Eigen::Isometry3f T_part_corner = result.T_corner_part.inverse().cast<float>();
  const Eigen::Vector3f up = T_part_corner.linear().col(2);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const Eigen::Vector3d low((column + 0.5) * kCell_m, (row + 0.5) * kCell_m, -height);
      const Eigen::Vector3d high = low + Eigen::Vector3d(0, 0, 3 * height);
      const auto below = caster.cast(T_part_corner * low.cast<float>(), up);
      const auto above = caster.cast(T_part_corner * high.cast<float>(), -up);
      if (below) result.bottom.at(column, row) = below->distance_m - height;
      if (above) result.top.at(column, row) = 2 * height - above->distance_m;
    }
  }
  return result;
}

/// Each cell as high as the highest of its neighbours, so that what lies between the middles of
/// cells is not forgotten.
HeightMap widened(const HeightMap& map)
{
  HeightMap result = map;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      for (int r = std::max(0, row - 1); r <= std::min(map.rows - 1, row + 1); ++r)
        for (int c = std::max(0, column - 1); c <= std::min(map.columns - 1, column + 1); ++c)
          result.at(column, row) = std::max(result.at(column, row), map.at(c, r));
  return result;
}

/// How far the part comes down at a place.
double restingHeight(const HeightMap& pile, const TurnedPart& part, int column, int row)
{
  double lift = 0;
  for (int r = 0; r < part.bottom.rows; ++r)
    for (int c = 0; c < part.bottom.columns; ++c)
    {
      const double under = pile.at(column + c, row + r);
      if (under > 0) lift = std::max(lift, under - part.bottom.at(c, r));
    }
  return lift;
}

/// The lowest of a few random places; none if the part is larger than the pile's floor.
std::optional<Place> lowestPlace(const HeightMap& pile, const TurnedPart& part, Random& random)
{
  const int columns = pile.columns - part.bottom.columns;
  const int rows = pile.rows - part.bottom.rows;
  if (columns < 0 || rows < 0) return std::nullopt;
  std::optional<Place> best;
  for (int trial = 0; trial < kPlaces; ++trial)
  {
    Place place{random.below(columns + 1), random.below(rows + 1), 0};
    place.lift = restingHeight(pile, part, place.column, place.row);
    if (!best || place.lift < best->lift) best = place;
  }
  return best;
}

void addToPile(HeightMap& pile, const TurnedPart& part, const Place& place)
{
  for (int r = 0; r < part.top.rows; ++r)
    for (int c = 0; c < part.top.columns; ++c)
    {
      double& height = pile.at(place.column + c, place.row + r);
      height = std::max(height, part.top.at(c, r) + place.lift);
    }
}
}  // namespace

TriangleMesh binMesh(const Bin& bin)
{
  TriangleMesh mesh;
  const auto add_box = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high)
  {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 8; ++corner)
      mesh.vertices.emplace_back(static_cast<float>((corner & 1) != 0 ? high.x() : low.x()),
                                 static_cast<float>((corner & 2) != 0 ? high.y() : low.y()),
                                 static_cast<float>((corner & 4) != 0 ? high.z() : low.z()));
    // Corners of each side, turning left as seen from outside.
    constexpr std::uint32_t kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : kSides)
    {
      mesh.triangles.push_back({first + s[0], first + s[1], first + s[2]});
      mesh.triangles.push_back({first + s[0], first + s[2], first + s[3]});
    }
  };
  const double x = bin.size_m.x() / 2, y = bin.size_m.y() / 2, z = bin.size_m.z(), w = bin.wall_m;
  add_box({-x - w, -y - w, -w}, {x + w, y + w, 0});
  add_box({-x - w, -y - w, 0}, {-x, y + w, z});
  add_box({x, -y - w, 0}, {x + w, y + w, z});
  add_box({-x, -y - w, 0}, {x, -y, z});
  add_box({-x, y, 0}, {x, y + w, z});
  return mesh;
}

std::vector<Eigen::Isometry3d> fillBin(const Bin& bin, const TriangleMesh& part, int count,
                                       std::uint32_t seed)
{
  Random random(seed);
  const Eigen::Vector3d center = centerOfMass(part);
  const RayCaster caster({{&part, Eigen::Isometry3d::Identity()}});
  const Eigen::Vector3d inside = bin.size_m - Eigen::Vector3d::Constant(2 * kMargin_m);
  HeightMap pile(static_cast<int>(std::max(0.0, inside.x() / kCell_m)),
                 static_cast<int>(std::max(0.0, inside.y() / kCell_m)), 0);
  std::vector<Eigen::Isometry3d> poses;
  for (int index = 0; index < count; ++index)
  {
    const HeightMap ground = widened(pile);
    std::optional<TurnedPart> best;
    Place best_place;
    for (int trial = 0; trial < kOrientations; ++trial)
    {
      Eigen::Quaterniond rotation = restingOrientation(part, center, random);
      if (trial % 2 != 0)
        rotation =
            Eigen::AngleAxisd(random.uniform(0, kMaxLean_rad), random.direction()) * rotation;
      const TurnedPart candidate = turned(part, caster, center, rotation);
      const auto place = lowestPlace(ground, candidate, random);
      if (!place) continue;
      if (best && place->lift + candidate.center_height >= best_place.lift + best->center_height)
        continue;
      best = candidate;
      best_place = *place;
    }
    if (!best)
      throw std::invalid_argument(
          "the part does not fit into the bin: check the part's unit, or "
          "give a larger bin");
    addToPile(pile, *best, best_place);
    const Eigen::Vector3d corner(best_place.column * kCell_m - inside.x() / 2,
                                 best_place.row * kCell_m - inside.y() / 2, best_place.lift);
    poses.push_back(Eigen::Translation3d(corner) * best->T_corner_part);
  }
  return poses;
}
}  // namespace ppf_bin_picking

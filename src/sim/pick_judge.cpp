#include "ppf_bin_picking/sim/pick_judge.hpp"

#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
std::vector<Eigen::Vector3d> verticesOf(const TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    vertices.push_back(vertex.cast<double>());
  return vertices;
}

PickRule checked(const PickRule& rule)
{
  if (!(rule.tolerance_rel > 0 && rule.tolerance_rel <= 1))
    throw std::invalid_argument("the pick's tolerance_rel is out of range: give it above 0 to 1");
  if (!(rule.contact_m >= 0.0001 && rule.contact_m <= 0.1))
    throw std::invalid_argument("the pick's contact_m is out of range: give it from 0.0001 to 0.1");
  if (!(rule.push_rel >= 0.01 && rule.push_rel <= 1))
    throw std::invalid_argument("the pick's push_rel is out of range: give it from 0.01 to 1");
  return rule;
}

/// A box around a mesh at a pose.
Eigen::AlignedBox3d boundsOf(const TriangleMesh& mesh, const Eigen::Isometry3d& T_bin_part)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    box.extend(T_bin_part * vertex.cast<double>());
  return box;
}

/// Whether something in one box may be in the way of something in the other, which goes up.
bool isBesideOrAbove(const Eigen::AlignedBox3d& other, Eigen::AlignedBox3d part)
{
  part.max().z() = std::max(part.max().z(), other.max().z());
  return part.intersects(other);
}

/// Heights of a mesh on vertical lines, a square grid of them.
class HeightMap
{
public:
  HeightMap(const Eigen::AlignedBox3d& bounds, double spacing_m)
      : low_(bounds.min()), high_z_(bounds.max().z()), spacing_m_(spacing_m)
  {
    const Eigen::Vector3d size = bounds.sizes();
    width = static_cast<int>(std::ceil(size.x() / spacing_m)) + 1;
    height = static_cast<int>(std::ceil(size.y() / spacing_m)) + 1;
  }

  /// Of the lowest surface; infinity where there is none.
  void lookUp(const RayCaster& mesh)
  {
    fill(kNowhere,
         [&](const Eigen::Vector2d& p) {
           return distance(mesh, {p.x(), p.y(), low_.z() - kAway_m}, 1, low_.z() - kAway_m);
         });
  }
  /// Of the highest surface; minus infinity where there is none.
  void lookDown(const RayCaster& mesh)
  {
    fill(-kNowhere,
         [&](const Eigen::Vector2d& p) {
           return distance(mesh, {p.x(), p.y(), high_z_ + kAway_m}, -1, high_z_ + kAway_m);
         });
  }

  double at(int i, int j) const { return z_m_[static_cast<std::size_t>(j) * width + i]; }

  int width = 0;
  int height = 0;

private:
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  static constexpr double kAway_m = 0.01;

  template <class Look>
  void fill(double nowhere, const Look& look)
  {
    z_m_.clear();
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        z_m_.push_back(
            look({low_.x() + i * spacing_m_, low_.y() + j * spacing_m_}).value_or(nowhere));
  }
  static std::optional<double> distance(const RayCaster& mesh, const Eigen::Vector3d& from, int up,
                                        double z_m)
  {
    const Eigen::Vector3f direction(0, 0, static_cast<float>(up));
    const auto hit = mesh.cast(from.cast<float>(), direction);
    if (!hit) return std::nullopt;
    return z_m + up * static_cast<double>(hit->distance_m);
  }

  Eigen::Vector3d low_;
  double high_z_;
  double spacing_m_;
  std::vector<double> z_m_;
};

/// On how many lines one part is in another's way up, if it is moved by whole cells.
/// @param above  Reaches `margin` cells further than `below` to each side.
std::size_t linesShared(const HeightMap& below, const HeightMap& above, int margin,
                        const std::pair<int, int>& move, double contact_m)
{
  std::size_t count = 0;
  for (int j = 0; j < below.height; ++j)
    for (int i = 0; i < below.width; ++i)
      if (above.at(i + margin - move.first, j + margin - move.second) - below.at(i, j) > contact_m)
        ++count;
  return count;
}

/// No move, and moves all around by half of the margin and by all of it. In cells.
std::vector<std::pair<int, int>> movesWithin(int margin)
{
  constexpr int kDirections = 16;
  std::vector<std::pair<int, int>> moves = {{0, 0}};
  for (const double way : {0.5 * margin, 1.0 * margin})
    for (int k = 0; k < kDirections; ++k)
    {
      const double angle = 2 * M_PI * k / kDirections;
      moves.emplace_back(std::lround(way * std::cos(angle)), std::lround(way * std::sin(angle)));
    }
  return moves;
}

std::string takenText(const PickVerdict& verdict)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "part " << verdict.part
       << " is taken, its surface off by up to " << 1000 * verdict.error_m << " mm";
  return text.str();
}
}  // namespace

PickJudge::PickJudge(TriangleMesh part, const SymmetryGroup& symmetries, const PickRule& rule)
    : part_(std::move(part)), rule_(checked(rule)), errors_(verticesOf(part_), symmetries)
{
}

/// Swept upwards, the part fills each vertical line from its lowest surface on. What is higher than
/// that is in the way, unless it can be pushed aside.
std::optional<std::size_t> PickJudge::partOver(
    std::size_t index, const std::vector<Eigen::Isometry3d>& T_bin_parts) const
{
  const double push_m = rule_.push_rel * errors_.diameter();
  const double spacing_m = std::min(rule_.contact_m / 2, push_m / 2);
  const int margin = static_cast<int>(std::lround(push_m / spacing_m));
  const std::vector<std::pair<int, int>> moves = movesWithin(margin);
  const Eigen::AlignedBox3d bounds = boundsOf(part_, T_bin_parts[index]);
  HeightMap below(bounds, spacing_m);
  below.lookUp(RayCaster({{&part_, T_bin_parts[index]}}));

  std::optional<std::size_t> over;
  std::size_t most = 0;
  for (std::size_t other = 0; other < T_bin_parts.size(); ++other)
  {
    const Eigen::AlignedBox3d other_bounds = boundsOf(part_, T_bin_parts[other]);
    if (other == index || !isBesideOrAbove(other_bounds, bounds)) continue;
    const Eigen::Vector3d reach(margin * spacing_m, margin * spacing_m, 0);
    Eigen::AlignedBox3d around(bounds.min() - reach, bounds.max() + reach);
    around.max().z() = other_bounds.max().z();
    HeightMap above(around, spacing_m);
    above.lookDown(RayCaster({{&part_, T_bin_parts[other]}}));
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const std::pair<int, int>& move : moves)
      least = std::min(least, linesShared(below, above, margin, move, rule_.contact_m));
    if (least <= most) continue;
    most = least;
    over = other;
  }
  return over;
}

std::string PickJudge::missText(const Eigen::Isometry3d& T_bin_model,
                                const Eigen::Isometry3d& T_bin_nearest,
                                const PickVerdict& verdict) const
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "no part lies there: the nearest, part "
       << verdict.part << ", is off by " << 1000 * errors_.translation(T_bin_model, T_bin_nearest)
       << " mm and " << errors_.rotation(T_bin_model, T_bin_nearest) * 180 / M_PI
       << " deg, its surface by up to " << 1000 * verdict.error_m << " mm, of which "
       << 1000 * rule_.tolerance_rel * errors_.diameter() << " are allowed";
  return text.str();
}

PickVerdict PickJudge::judge(const Eigen::Isometry3d& T_bin_model,
                             const std::vector<Eigen::Isometry3d>& T_bin_parts) const
{
  PickVerdict verdict;
  verdict.error_m = PoseErrors::kAnyDistance;
  Eigen::Isometry3d T_bin_nearest = Eigen::Isometry3d::Identity();
  for (std::size_t part = 0; part < T_bin_parts.size(); ++part)
  {
    const NearestTruth truth = errors_.mssd(T_bin_model, T_bin_parts[part], verdict.error_m);
    if (!(truth.error_m < verdict.error_m)) continue;
    verdict.error_m = truth.error_m;
    verdict.part = part;
    T_bin_nearest = truth.T_camera_model;
  }
  if (T_bin_parts.empty())
    verdict.message = "no part lies there: the bin is empty";
  else if (!(verdict.error_m <= rule_.tolerance_rel * errors_.diameter()))
    verdict.message = missText(T_bin_model, T_bin_nearest, verdict);
  else if (const auto other = partOver(verdict.part, T_bin_parts))
  {
    verdict.outcome = PickOutcome::kCovered;
    verdict.covered_by = *other;
    verdict.message = "part " + std::to_string(verdict.part) + " is meant, but part " +
                      std::to_string(*other) + " lies on it";
  }
  else
  {
    verdict.outcome = PickOutcome::kTaken;
    verdict.message = takenText(verdict);
  }
  return verdict;
}
}  // namespace ppf_bin_picking

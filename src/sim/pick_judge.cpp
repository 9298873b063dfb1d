#include "ppf_bin_picking/sim/pick_judge.hpp"

#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
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

/// Vertical columns over a part's footprint, and which part lies over it in each.
class ColumnGrid
{
public:
  ColumnGrid(const Eigen::AlignedBox3d& bounds, double spacing_m)
      : low_(bounds.min().head<2>()), spacing_m_(spacing_m)
  {
    const Eigen::Vector3d size = bounds.sizes();
    width_ = static_cast<int>(std::ceil(size.x() / spacing_m)) + 1;
    height_ = static_cast<int>(std::ceil(size.y() / spacing_m)) + 1;
    over_.assign(static_cast<std::size_t>(width_) * height_, kFree);
  }

  /// Swept upwards, a part fills each column from its lowest surface on. What is higher than that
  /// by more than contact_m is in the way.
  void look(const RayCaster& part, const RayCaster& others, double below, double above,
            double contact_m)
  {
    for (int j = 0; j < height_; ++j)
      for (int i = 0; i < width_; ++i)
      {
        const auto lowest = part.cast(place(i, j, below), Eigen::Vector3f::UnitZ());
        if (!lowest) continue;
        const auto highest = others.cast(place(i, j, above), -Eigen::Vector3f::UnitZ());
        if (!highest) continue;
        const double shared = above - highest->distance_m - (below + lowest->distance_m);
        if (shared > contact_m) over(i, j) = static_cast<int>(highest->object);
      }
  }

  /// For each other part, over how many columns it lies, with others all around.
  std::vector<std::size_t> covered(std::size_t other_count)
  {
    std::vector<std::size_t> columns(other_count, 0);
    for (int j = 1; j + 1 < height_; ++j)
      for (int i = 1; i + 1 < width_; ++i)
        if (over(i, j) != kFree && over(i - 1, j) != kFree && over(i + 1, j) != kFree &&
            over(i, j - 1) != kFree && over(i, j + 1) != kFree)
          ++columns[static_cast<std::size_t>(over(i, j))];
    return columns;
  }

private:
  static constexpr int kFree = -1;

  int& over(int i, int j) { return over_[static_cast<std::size_t>(j) * width_ + i]; }
  Eigen::Vector3f place(int i, int j, double z) const
  {
    return Eigen::Vector3d(low_.x() + i * spacing_m_, low_.y() + j * spacing_m_, z).cast<float>();
  }

  Eigen::Vector2d low_;
  double spacing_m_;
  int width_ = 0;
  int height_ = 0;
  std::vector<int> over_;
};

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

std::optional<std::size_t> PickJudge::partOver(
    std::size_t index, const std::vector<Eigen::Isometry3d>& T_bin_parts) const
{
  const RayCaster part({{&part_, T_bin_parts[index]}});
  const Eigen::AlignedBox3d bounds = boundsOf(part_, T_bin_parts[index]);
  double top = bounds.max().z();
  std::vector<PlacedMesh> placed;
  for (std::size_t other = 0; other < T_bin_parts.size(); ++other)
  {
    if (other == index) continue;
    placed.push_back({&part_, T_bin_parts[other]});
    top = std::max(top, boundsOf(part_, T_bin_parts[other]).max().z());
  }
  ColumnGrid grid(bounds, rule_.contact_m / 2);
  grid.look(part, RayCaster(placed), bounds.min().z() - rule_.contact_m, top + rule_.contact_m,
            rule_.contact_m);
  const std::vector<std::size_t> columns = grid.covered(placed.size());
  const auto most = std::max_element(columns.begin(), columns.end());
  if (most == columns.end() || *most == 0) return std::nullopt;
  const auto other = static_cast<std::size_t>(most - columns.begin());
  return other < index ? other : other + 1;
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

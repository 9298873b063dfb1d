#include "symmetry_axes.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>

namespace ppf_bin_picking
{
namespace
{
constexpr double kSmoothRel = 0.04;       // radius of the normals' mean: facets of a round differ
constexpr float kSameSide = 0.5F;         // cosine between normals that are averaged
constexpr double kLikeRadiusRel = 0.012;  // distances from the centre that are alike
constexpr double kLikeSlope = 0.15;       // ... and cosines of normal and line from the centre
constexpr double kLeastRadiusRel = 0.15;  // nearer to the centre a point tells little of a turn
constexpr double kLeastSlope = 0.3;       // and so where the normal points from the centre
constexpr int kPointsTried = 200;
constexpr int kPointsUsed = 3;
constexpr std::size_t kSamples = 200;
constexpr double kLooseRel = 0.03;
constexpr double kLeastTurn_rad = 0.04;
constexpr double kSameTurn_rad = 0.1;   // of one that fits
constexpr double kSameMiss_rad = 0.03;  // of one that does not

/// A point of the surface as a turn about the centre sees it.
struct Landmark
{
  Eigen::Matrix3d frame;  ///< Along the line from the centre, and across it along the normal.
  double radius_m;
  double slope;  ///< Cosine between normal and line.
};

std::optional<Landmark> landmarkOf(const Eigen::Vector3d& from_center,
                                   const Eigen::Vector3d& normal)
{
  Landmark mark;
  mark.radius_m = from_center.norm();
  if (!(mark.radius_m > 0)) return std::nullopt;
  const Eigen::Vector3d x = from_center / mark.radius_m;
  mark.slope = normal.dot(x);
  const Eigen::Vector3d across = x.cross(normal);
  if (across.norm() < kLeastSlope) return std::nullopt;
  const Eigen::Vector3d z = across.normalized();
  mark.frame << x, z.cross(x), z;
  return mark;
}

std::vector<Landmark> landmarksOf(const SelfDistance& self)
{
  const OrientedPoints& surface = self.surface();
  const NeighborSearch search(surface.points);
  std::vector<std::uint32_t> near;
  std::vector<Landmark> marks;
  const auto radius_m = static_cast<float>(kSmoothRel * self.diameter());
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    search.within(surface.points[i], radius_m, near);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const std::uint32_t j : near)
      if (surface.normals[j].dot(surface.normals[i]) > kSameSide) mean += surface.normals[j];
    const auto mark = landmarkOf(surface.points[i].cast<double>() - self.center(),
                                 mean.normalized().cast<double>());
    if (mark && mark->radius_m > kLeastRadiusRel * self.diameter()) marks.push_back(*mark);
  }
  return marks;
}

bool alike(const Landmark& a, const Landmark& b, double diameter_m)
{
  return std::abs(a.radius_m - b.radius_m) < kLikeRadiusRel * diameter_m &&
         std::abs(a.slope - b.slope) < kLikeSlope;
}

bool isAmong(const std::vector<Eigen::Quaterniond>& known, const Eigen::Quaterniond& rotation,
             double within_rad)
{
  const double least_dot = std::cos(within_rad / 2);
  return std::any_of(known.begin(), known.end(),
                     [&](const Eigen::Quaterniond& other)
                     { return std::abs(other.dot(rotation)) > least_dot; });
}

/// The landmarks with the fewest like them, of those tried.
std::vector<std::size_t> rarest(const std::vector<Landmark>& marks, double diameter_m)
{
  std::vector<std::pair<std::ptrdiff_t, std::size_t>> counts;
  const std::size_t step = std::max<std::size_t>(1, marks.size() / kPointsTried);
  for (std::size_t i = 0; i < marks.size(); i += step)
    counts.emplace_back(
        std::count_if(marks.begin(), marks.end(),
                      [&](const Landmark& mark) { return alike(mark, marks[i], diameter_m); }),
        i);
  std::sort(counts.begin(), counts.end());
  std::vector<std::size_t> chosen;
  for (const auto& [count, index] : counts)
    if (chosen.size() < kPointsUsed) chosen.push_back(index);
  return chosen;
}
}  // namespace

std::vector<SymmetryAxis> principalLines(const SelfDistance& self)
{
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : self.surface().points)
  {
    const Eigen::Vector3d arm = point.cast<double>() - self.center();
    moments += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  std::vector<SymmetryAxis> lines;
  for (int i = 0; i < 3; ++i)
    lines.push_back({solver.eigenvectors().col(i), self.center()});
  return lines;
}

std::vector<SymmetryAxis> linesOfLikePoints(const SelfDistance& self)
{
  const std::vector<Landmark> marks = landmarksOf(self);
  const double loose_m = kLooseRel * self.diameter();
  std::vector<Eigen::Quaterniond> fits, misses;
  std::vector<SymmetryAxis> lines;
  for (const std::size_t i : rarest(marks, self.diameter()))
    for (const Landmark& other : marks)
    {
      if (!alike(other, marks[i], self.diameter())) continue;
      const Eigen::Matrix3d rotation = other.frame * marks[i].frame.transpose();
      const Eigen::AngleAxisd turn(rotation);
      const Eigen::Quaterniond quaternion(rotation);
      if (turn.angle() < kLeastTurn_rad || isAmong(fits, quaternion, kSameTurn_rad) ||
          isAmong(misses, quaternion, kSameMiss_rad))
        continue;
      const SymmetryAxis line{turn.axis(), self.center()};
      const bool fit = self.deviation(turnAbout(line, turn.angle()), loose_m, kSamples) <= loose_m;
      (fit ? fits : misses).push_back(quaternion);
      if (!fit) continue;
      lines.push_back(line);
    }
  return lines;
}
}  // namespace ppf_bin_picking

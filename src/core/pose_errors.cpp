#include "ppf_bin_picking/core/pose_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d meanOf(const Points& points)
{
  const Eigen::Vector3d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector3d(Eigen::Vector3d::Zero()));
  return sum / static_cast<double>(points.size());
}

/// The largest distance between two points. No two whose distances from the middle add up to less
/// than the best so far need to be looked at.
double largestDistance(Points points)
{
  const Eigen::Vector3d middle = meanOf(points);
  for (Eigen::Vector3d& point : points)
    point -= middle;
  std::sort(points.begin(), points.end(),
            [](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
            { return a.squaredNorm() > b.squaredNorm(); });
  double largest = 0;
  for (std::size_t i = 0; i < points.size() && 2 * points[i].norm() > largest; ++i)
    for (std::size_t j = i + 1; j < points.size() && points[i].norm() + points[j].norm() > largest;
         ++j)
      largest = std::max(largest, (points[i] - points[j]).norm());
  return largest;
}

Points evenlySpaced(const Points& points, std::size_t count)
{
  if (points.size() <= count) return points;
  const double step = static_cast<double>(points.size() - 1) / static_cast<double>(count - 1);
  Points spaced;
  for (std::size_t i = 0; i < count; ++i)
    spaced.push_back(points[static_cast<std::size_t>(std::lround(static_cast<double>(i) * step))]);
  return spaced;
}

/// The products of the motions with turns all around a line.
std::vector<Eigen::Isometry3d> withTurns(const std::vector<Eigen::Isometry3d>& motions,
                                         const SymmetryAxis& line, double step_rad)
{
  const auto turns = static_cast<int>(std::lround(2 * M_PI / step_rad));
  std::vector<Eigen::Isometry3d> products;
  for (const Eigen::Isometry3d& motion : motions)
    for (int i = 0; i < turns; ++i)
      products.push_back(motion * Eigen::Translation3d(line.point) *
                         Eigen::AngleAxisd(i * step_rad, line.axis) *
                         Eigen::Translation3d(-line.point));
  return products;
}

/// The difference of two poses, as the matrix that maps a point to the way between its two places.
Eigen::Matrix<double, 3, 4> differenceOf(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return a.matrix().topRows<3>() - b.matrix().topRows<3>();
}

Eigen::Vector3d wayOf(const Eigen::Matrix<double, 3, 4>& difference, const Eigen::Vector3d& point)
{
  return difference.leftCols<3>() * point + difference.col(3);
}
}  // namespace

PoseErrors::PoseErrors(const std::vector<Eigen::Vector3d>& vertices,
                       const SymmetryGroup& symmetries)
    : motions_(symmetries.motions())
{
  const auto finite = [](const Eigen::Vector3d& vertex) { return vertex.allFinite(); };
  if (vertices.empty() || !std::all_of(vertices.begin(), vertices.end(), finite))
    throw std::invalid_argument(
        "poses cannot be compared by no vertices or by ones that are not finite: give those of "
        "the part's mesh");
  vertices_ = evenlySpaced(vertices, kMaxVertices);
  mean_ = meanOf(vertices_);
  diameter_m_ = largestDistance(vertices);
  if (symmetries.sphere())
  {
    sphere_center_ = symmetries.sphereCenter();
    motions_ = {Eigen::Isometry3d::Identity()};
  }
  else if (symmetries.revolution())
  {
    axis_ = symmetries.revolution()->axis;
    motions_ = withTurns(motions_, *symmetries.revolution(), kTurn_rad);
  }
}

Eigen::Isometry3d PoseErrors::turnedTruth(const Eigen::Isometry3d& found,
                                          const Eigen::Isometry3d& truth) const
{
  if (!sphere_center_) return truth;
  Eigen::Isometry3d turned = found;
  turned.translation() = truth * *sphere_center_ - found.linear() * *sphere_center_;
  return turned;
}

NearestTruth PoseErrors::mssd(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth,
                              double below_m) const
{
  NearestTruth nearest;
  double best = below_m;
  const Eigen::Isometry3d start = turnedTruth(found, truth);
  for (const Eigen::Isometry3d& motion : motions_)
  {
    const Eigen::Isometry3d candidate = start * motion;
    const Eigen::Matrix<double, 3, 4> difference = differenceOf(found, candidate);
    if (wayOf(difference, mean_).norm() >= best) continue;  // the largest is not below the mean
    double largest = 0;
    for (const Eigen::Vector3d& vertex : vertices_)
    {
      largest = std::max(largest, wayOf(difference, vertex).squaredNorm());
      if (largest >= best * best) break;
    }
    largest = std::sqrt(largest);
    if (largest >= best) continue;
    best = largest;
    nearest = {best, candidate};
  }
  return nearest;
}

double PoseErrors::mspd(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth,
                        const PinholeCamera& camera, double below_px) const
{
  const auto project = [&](const Eigen::Vector3d& p)
  { return Eigen::Vector2d(camera.fx * p.x() / p.z(), camera.fy * p.y() / p.z()); };
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& vertex : vertices_)
  {
    const Eigen::Vector3d p = found * vertex;
    if (!(p.z() > 0)) return kAnyDistance;
    pixels.push_back(project(p));
  }
  bool is_below = false;
  double best = below_px;
  const Eigen::Isometry3d start = turnedTruth(found, truth);
  for (const Eigen::Isometry3d& motion : motions_)
  {
    const Eigen::Isometry3d candidate = start * motion;
    double largest = 0;
    for (std::size_t i = 0; i < vertices_.size() && largest < best; ++i)
    {
      const Eigen::Vector3d p = candidate * vertices_[i];
      largest = p.z() > 0 ? std::max(largest, (project(p) - pixels[i]).norm()) : kAnyDistance;
    }
    if (!(largest < best)) continue;
    best = largest;
    is_below = true;
  }
  return is_below ? best : kAnyDistance;
}

double PoseErrors::translation(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  return wayOf(differenceOf(a, b), mean_).norm();
}

double PoseErrors::rotation(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const double cosine = axis_ ? (a.linear() * *axis_).dot(b.linear() * *axis_)
                              : ((a.linear().transpose() * b.linear()).trace() - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/orbits.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kSameCircle = 0.5F;        // steps
constexpr float kSameNormal = 0.8660254F;  // cosine of 30 degrees
constexpr float kOnAxis = 0.5F;            // steps from the axis within which no side is known
constexpr float kTie = 1e-3F;              // steps

// One would do, but the orientations voted for would be turns of one: the distribution shows them.
constexpr std::size_t kOfSphere = 32;

/// What a revolution leaves of a sample: place and normal in the half plane through the axis, and
/// across it.
struct Circle
{
  Eigen::Vector2f place;   ///< From the axis, along it [m].
  Eigen::Vector3f normal;  ///< From the axis, along it, round it.
};

Circle circleOf(const SymmetryAxis& axis, const Eigen::Vector3f& point,
                const Eigen::Vector3f& normal, float on_axis_m)
{
  const Eigen::Vector3f along = axis.axis.cast<float>();
  const Eigen::Vector3f from = point - axis.point.cast<float>();
  const Eigen::Vector3f out = from - along * along.dot(from);
  const float radius_m = out.norm();
  const float normal_along = along.dot(normal);
  Circle circle{{radius_m, along.dot(from)}, {0, normal_along, 0}};
  if (radius_m < on_axis_m)
    circle.normal.x() = (normal - along * normal_along).norm();
  else
    circle.normal = {normal.dot(out) / radius_m, normal_along,
                     normal.dot(along.cross(out)) / radius_m};
  return circle;
}

/// The first sample of each circle, counting the discrete symmetries.
std::vector<std::uint8_t> firstOfCircles(const SymmetryGroup& symmetries,
                                         const Eigen::Vector3f& center, float step_m,
                                         const OrientedPoints& samples)
{
  std::vector<std::uint8_t> chosen(samples.size(), 0);
  std::vector<Circle> known;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const auto is_known = [&](const Eigen::Isometry3d& motion)
    {
      const Circle circle =
          circleOf(*symmetries.revolution(), motion.cast<float>() * (samples.points[i] + center),
                   motion.linear().cast<float>() * samples.normals[i], kOnAxis * step_m);
      return std::any_of(known.begin(), known.end(),
                         [&](const Circle& other)
                         {
                           return (other.place - circle.place).norm() < kSameCircle * step_m &&
                                  other.normal.dot(circle.normal) > kSameNormal;
                         });
    };
    if (std::any_of(symmetries.motions().begin(), symmetries.motions().end(), is_known)) continue;
    chosen[i] = 1;
    known.push_back(circleOf(*symmetries.revolution(), samples.points[i] + center,
                             samples.normals[i], kOnAxis * step_m));
  }
  return chosen;
}
}  // namespace

std::vector<std::uint8_t> inFundamentalDomain(const SymmetryGroup& symmetries,
                                              const Eigen::Vector3f& center, float tie_m,
                                              const std::vector<Eigen::Vector3f>& points)
{
  // Of each orbit the point that lies farthest along a direction that no symmetry should keep.
  const Eigen::Vector3f direction = Eigen::Vector3f(0.61F, 0.53F, 0.59F).normalized();
  std::vector<std::uint8_t> inside(points.size(), 1);
  for (const Eigen::Isometry3d& motion : symmetries.motions())
  {
    const Eigen::Isometry3f T_model_model = motion.cast<float>();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (direction.dot(T_model_model * (points[i] + center) - center - points[i]) > tie_m)
        inside[i] = 0;
  }
  return inside;
}

std::size_t moveRepresentativesToFront(const SymmetryGroup& symmetries,
                                       const Eigen::Vector3f& center, float step_m,
                                       OrientedPoints& samples)
{
  std::vector<std::uint8_t> chosen(samples.size(), 0);
  if (symmetries.sphere())
    for (std::size_t k = 0; k < kOfSphere && k < chosen.size(); ++k)
      chosen[k * chosen.size() / std::min(kOfSphere, chosen.size())] = 1;
  else if (symmetries.revolution())
    chosen = firstOfCircles(symmetries, center, step_m, samples);
  else
    chosen = inFundamentalDomain(symmetries, center, kTie * step_m, samples.points);
  OrientedPoints sorted;
  std::size_t count = 0;
  for (const bool wanted : {true, false})
  {
    for (std::size_t i = 0; i < samples.size(); ++i)
      if ((chosen[i] != 0) == wanted) sorted.add(samples.points[i], samples.normals[i]);
    if (wanted) count = sorted.size();
  }
  samples = std::move(sorted);
  return count;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/sim/depth_camera.hpp"

#include "ppf_bin_picking/core/parallel.hpp"

#include "ppf_bin_picking/sim/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr float kLift_m = 1e-5F;  // off a surface, so that it does not shade itself

/// What a pixel sees, before chance has its say.
struct Sight
{
  double depth_m = 0;
  double slope_m = 0;     ///< Change of the depth from this pixel to the next, uphill.
  bool lit = false;       ///< Seen by camera and projector.
  bool measured = false;  ///< Lit, neither too slanted nor dazzling.
};

/// A shot in the making.
struct Shot
{
  const RayCaster& world;
  const DepthSensor& sensor;
  const Eigen::Isometry3d& T_world_camera;
  std::vector<Sight> sights;  ///< Row after row.
  DepthView view;
};

/// A seed of its own for each row, so that rows can be done in any order.
std::uint32_t rowSeed(std::uint32_t seed, std::size_t row)
{
  return (seed * 2654435761U) ^ (static_cast<std::uint32_t>(row) * 2246822519U + 374761393U);
}

/// Through the middle of a pixel, optical frame, unit length.
Eigen::Vector3d unitRay(const PinholeCamera& camera, int column, int row)
{
  return camera.ray(static_cast<float>(column), static_cast<float>(row))
      .cast<double>()
      .normalized();
}

/// What light does at a point: whether the projector reaches it, and whether the camera then
/// measures it.
/// @param point   Camera frame [m].
/// @param normal  Camera frame, unit length, towards the camera.
void light(const Shot& shot, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
           Sight& sight)
{
  const DepthSensor& sensor = shot.sensor;
  const Eigen::Vector3d projector(sensor.baseline_m, 0, 0);
  const Eigen::Vector3d to_camera = -point.normalized();
  const Eigen::Vector3d to_projector = (projector - point).normalized();
  const Eigen::Vector3d start = point + kLift_m * normal;
  sight.lit = sensor.baseline_m == 0 ||
              !shot.world.blocked((shot.T_world_camera * start).cast<float>(),
                                  (shot.T_world_camera * projector).cast<float>());
  const auto angle = [&](const Eigen::Vector3d& direction)
  { return std::atan2(normal.cross(direction).norm(), normal.dot(direction)); };
  sight.measured = sight.lit && angle(to_camera) <= sensor.max_slant_rad &&
                   angle(to_projector) <= sensor.max_slant_rad &&
                   angle((to_camera + to_projector).normalized()) >= sensor.glare_rad;
}

/// First pass: what there is to see.
void lookAlongRow(std::size_t row, Shot& shot)
{
  const PinholeCamera& camera = shot.sensor.camera;
  const Eigen::Vector3f origin = shot.T_world_camera.translation().cast<float>();
  for (int column = 0; column < camera.width; ++column)
  {
    const Eigen::Vector3d ray = unitRay(camera, column, static_cast<int>(row));
    const Eigen::Vector3f direction = (shot.T_world_camera.linear() * ray).cast<float>();
    const auto hit = shot.world.cast(origin, direction);
    if (!hit) continue;
    const std::size_t pixel = row * camera.width + column;
    shot.view.object[pixel] = static_cast<std::int32_t>(hit->object);
    shot.view.brightness[pixel] = std::abs(hit->normal.dot(direction));
    Eigen::Vector3d normal = shot.T_world_camera.linear().transpose() * hit->normal.cast<double>();
    if (normal.dot(ray) > 0) normal = -normal;
    Sight& sight = shot.sights[pixel];
    sight.depth_m = hit->distance_m * ray.z();
    // The plane n . p = c has the depth c / (n . r) at the pixel with the ray r, r.z = 1.
    sight.slope_m = sight.depth_m * ray.z() *
                    std::hypot(normal.x() / camera.fx, normal.y() / camera.fy) /
                    std::max(std::abs(normal.dot(ray)), 1e-6);
    light(shot, hit->distance_m * ray, normal, sight);
  }
}

/// The nearest and the farthest depth around a pixel if a depth edge runs through there.
std::optional<std::pair<double, double>> edgeAround(const Shot& shot, int column, int row)
{
  const PinholeCamera& camera = shot.sensor.camera;
  const int reach = shot.sensor.flying_reach_px;
  const int right = std::min(column + reach, camera.width - 1);
  const int bottom = std::min(row + reach, camera.height - 1);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0;
  bool edge = false;
  for (int v = std::max(row - reach, 0); v <= bottom; ++v)
    for (int u = std::max(column - reach, 0); u <= right; ++u)
    {
      const Sight* sight = &shot.sights[static_cast<std::size_t>(v) * camera.width + u];
      if (!sight->lit) continue;
      nearest = std::min(nearest, sight->depth_m);
      farthest = std::max(farthest, sight->depth_m);
      const auto differs = [&](const Sight& other)
      { return other.lit && std::abs(other.depth_m - sight->depth_m) > shot.sensor.edge_step_m; };
      edge =
          edge || (u < right && differs(sight[1])) || (v < bottom && differs(sight[camera.width]));
    }
  if (!edge) return std::nullopt;
  return std::make_pair(nearest, farthest);
}

/// Second pass: what is measured of it.
void measureRow(std::size_t row, std::uint32_t seed, Shot& shot)
{
  const DepthSensor& sensor = shot.sensor;
  Random random(rowSeed(seed, row));
  for (int column = 0; column < sensor.camera.width; ++column)
  {
    // Drawn for every pixel, so that none depends on what the others see.
    const bool may_fly = random.uniform(0, 1) < sensor.flying_share;
    const double between = random.uniform(0, 1);
    const double noise = random.normal();
    const bool drops_out = random.uniform(0, 1) < sensor.dropout_share;
    const std::size_t pixel = row * sensor.camera.width + column;
    const Sight& sight = shot.sights[pixel];
    if (!sight.measured || drops_out) continue;
    double depth_m = sight.depth_m;
    if (may_fly)
      if (const auto edge = edgeAround(shot, column, static_cast<int>(row)))
        depth_m = edge->first + between * (edge->second - edge->first);
    depth_m += noise * std::hypot(sensor.noise_at_1m_m * sight.depth_m * sight.depth_m,
                                  sensor.lateral_noise_px * sight.slope_m);
    if (sensor.depth_step_m > 0)
      depth_m = sensor.depth_step_m * std::round(depth_m / sensor.depth_step_m);
    if (!(depth_m > 0)) continue;
    const Eigen::Vector3d ray = unitRay(sensor.camera, column, static_cast<int>(row));
    shot.view.cloud_camera.points[pixel] = (ray * (depth_m / ray.z())).cast<float>();
  }
}

/// Pixels that would show the part if nothing else were there.
std::size_t pixelsAlone(const RayCaster& part, const PinholeCamera& camera,
                        const Eigen::Isometry3d& T_part_camera, const TriangleMesh& mesh)
{
  const Eigen::AlignedBox2f image(Eigen::Vector2f::Zero(),
                                  Eigen::Vector2i(camera.width, camera.height).cast<float>());
  Eigen::AlignedBox2f seen;
  const Eigen::Isometry3d T_camera_part = T_part_camera.inverse();
  for (const Eigen::Vector3f& vertex : mesh.vertices)
  {
    const Eigen::Vector3f p = (T_camera_part * vertex.cast<double>()).cast<float>();
    if (!(p.z() > 0)) return 0;  // reaches behind the camera
    seen.extend(camera.project(p));
  }
  seen.clamp(image);
  if (seen.isEmpty()) return 0;
  const Eigen::Vector3f origin = T_part_camera.translation().cast<float>();
  std::size_t count = 0;
  for (int row = static_cast<int>(seen.min().y()); static_cast<float>(row) < seen.max().y(); ++row)
    for (int column = static_cast<int>(seen.min().x()); static_cast<float>(column) < seen.max().x();
         ++column)
      count +=
          part.cast(origin, (T_part_camera.linear() * unitRay(camera, column, row)).cast<float>())
              .has_value();
  return count;
}
}  // namespace

Eigen::Isometry3d lookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target)
{
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d down = forward.cross(Eigen::Vector3d::UnitX());
  if (!(down.norm() > 1e-6))
    throw std::invalid_argument("the camera looks along x or at itself: move it aside");
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear().col(2) = forward;
  T_world_camera.linear().col(1) = down.normalized();
  T_world_camera.linear().col(0) = down.normalized().cross(forward);
  T_world_camera.translation() = position;
  return T_world_camera;
}

DepthView takeShot(const RayCaster& world, const DepthSensor& sensor,
                   const Eigen::Isometry3d& T_world_camera, std::uint32_t seed, int threads)
{
  std::string problems;
  for (const std::string& problem : sensor.problems())
    problems += (problems.empty() ? "the depth sensor's " : "; ") + problem;
  if (!problems.empty()) throw std::invalid_argument(problems);
  const auto rows = static_cast<std::size_t>(sensor.camera.height);
  const std::size_t size = rows * sensor.camera.width;
  Shot shot{world, sensor, T_world_camera, std::vector<Sight>(size), {}};
  shot.view.cloud_camera.width = static_cast<std::size_t>(sensor.camera.width);
  shot.view.cloud_camera.height = rows;
  shot.view.cloud_camera.points.assign(
      size, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  shot.view.object.assign(size, -1);
  shot.view.brightness.assign(size, 0);
  parallelFor(threads, rows, [&](std::size_t row) { lookAlongRow(row, shot); });
  parallelFor(threads, rows, [&](std::size_t row) { measureRow(row, seed, shot); });
  return std::move(shot.view);
}

std::vector<PartTruth> partTruths(const DepthView& view, const PinholeCamera& camera,
                                  const Eigen::Isometry3d& T_world_camera, const TriangleMesh& part,
                                  const std::vector<Eigen::Isometry3d>& T_world_part,
                                  std::int32_t first_object)
{
  const RayCaster caster({{&part, Eigen::Isometry3d::Identity()}});
  std::vector<PartTruth> truths;
  for (std::size_t index = 0; index < T_world_part.size(); ++index)
  {
    PartTruth truth;
    truth.T_camera_model = T_world_camera.inverse() * T_world_part[index];
    const auto seen = std::count(view.object.begin(), view.object.end(),
                                 first_object + static_cast<std::int32_t>(index));
    const std::size_t alone = pixelsAlone(caster, camera, truth.T_camera_model.inverse(), part);
    if (alone > 0)
      truth.visible_share = std::min(1.0, static_cast<double>(seen) / static_cast<double>(alone));
    truths.push_back(truth);
  }
  return truths;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/sim/depth_camera.hpp"

#include "ppf_bin_picking/core/parallel.hpp"

#include "ppf_bin_picking/sim/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
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

void shootRow(const RayCaster& world, const PinholeCamera& camera,
              const Eigen::Isometry3d& T_world_camera, const DepthNoise& noise, std::uint32_t seed,
              std::size_t row, DepthView& view)
{
  Random random(rowSeed(seed, row));
  const Eigen::Vector3f origin = T_world_camera.translation().cast<float>();
  for (int column = 0; column < camera.width; ++column)
  {
    const double error_m = noise.std_m * random.normal();  // drawn for every pixel, hit or not
    const Eigen::Vector3d ray = unitRay(camera, column, static_cast<int>(row));
    const Eigen::Vector3f direction = (T_world_camera.linear() * ray).cast<float>();
    const auto hit = world.cast(origin, direction);
    if (!hit) continue;
    const std::size_t pixel = row * camera.width + column;
    view.object[pixel] = static_cast<std::int32_t>(hit->object);
    const float facing = std::abs(hit->normal.dot(direction));
    view.brightness[pixel] = facing;
    if (facing < std::cos(noise.max_slant_rad)) continue;
    const double depth_m = hit->distance_m * ray.z() + error_m;
    view.cloud_camera.points[pixel] = (ray * (depth_m / ray.z())).cast<float>();
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

DepthView takeShot(const RayCaster& world, const PinholeCamera& camera,
                   const Eigen::Isometry3d& T_world_camera, const DepthNoise& noise,
                   std::uint32_t seed, int threads)
{
  if (camera.width < 1 || camera.height < 2 || !(camera.fx > 0) || !(camera.fy > 0))
    throw std::invalid_argument(
        "the camera has no image or no focal length: give width >= 1, "
        "height >= 2, fx > 0 and fy > 0");
  const std::size_t size = static_cast<std::size_t>(camera.width) * camera.height;
  DepthView view;
  view.cloud_camera.width = static_cast<std::size_t>(camera.width);
  view.cloud_camera.height = static_cast<std::size_t>(camera.height);
  view.cloud_camera.points.assign(
      size, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  view.object.assign(size, -1);
  view.brightness.assign(size, 0);
  parallelFor(threads, static_cast<std::size_t>(camera.height),
              [&](std::size_t row)
              { shootRow(world, camera, T_world_camera, noise, seed, row, view); });
  return view;
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

#include "ppf_bin_picking/sim/cell_layout.hpp"

#include "ppf_bin_picking/core/surface_sampling.hpp"
#include "ppf_bin_picking/core/viewpoints.hpp"

#include "ppf_bin_picking/sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr int kDirections = 100;
constexpr int kRays = 80;             // along each side of the square that is cast from a direction
constexpr double kShadowShare = 1.6;  // of the floor
constexpr double kSideRatio = 4.0 / 3.0;
constexpr double kLayers = 3;  // that the walls can hold
constexpr double kMinSide_rel = 2.1;
constexpr double kFreeWall_rel = 0.5;
constexpr double kSlope = 0.176;       // tangent of 10 degrees
constexpr double kImageShare = 0.9;    // that the bin may fill
constexpr double kNearest_m = 0.5;     // what the sensors are made for
constexpr double kFarthest_m = 100.0;  // to end somewhere
constexpr double kStep_m = 0.005;

/// Radius of the sphere about the middle of the part's extent that holds every vertex.
struct Ball
{
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float radius_m = 0;
};

Ball ballAround(const TriangleMesh& part)
{
  Eigen::AlignedBox3f extent;
  for (const Eigen::Vector3f& vertex : part.vertices)
    extent.extend(vertex);
  if (extent.isEmpty()) return {};
  Ball ball{extent.center(), 0};
  for (const Eigen::Vector3f& vertex : part.vertices)
    ball.radius_m = std::max(ball.radius_m, (vertex - ball.center).norm());
  return ball;
}

/// Area of the silhouette seen against a direction.
double shadow(const RayCaster& caster, const Ball& ball, const Eigen::Vector3f& direction)
{
  const Eigen::Vector3f right = direction.unitOrthogonal();
  const Eigen::Vector3f down = direction.cross(right);
  const float cell_m = 2 * ball.radius_m / kRays;
  const Eigen::Vector3f corner = ball.center - 2 * ball.radius_m * direction;
  int hits = 0;
  for (int row = 0; row < kRays; ++row)
    for (int column = 0; column < kRays; ++column)
    {
      const Eigen::Vector2f place =
          Eigen::Vector2f(column, row).array() * cell_m - ball.radius_m + cell_m / 2;
      if (caster.cast(corner + place.x() * right + place.y() * down, direction)) ++hits;
    }
  return static_cast<double>(hits) * cell_m * cell_m;
}

/// Smallest extent over many directions [m].
double smallestWidth(const TriangleMesh& part)
{
  double smallest = std::numeric_limits<double>::infinity();
  const auto measure = [&](const Eigen::Vector3f& direction)
  {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const Eigen::Vector3f& vertex : part.vertices)
    {
      low = std::min(low, vertex.dot(direction));
      high = std::max(high, vertex.dot(direction));
    }
    smallest = std::min(smallest, static_cast<double>(high - low));
  };
  for (int k = 0; k < kDirections; ++k)
    measure(evenDirection(k, kDirections));
  for (int axis = 0; axis < 3; ++axis)  // the thickness of a plate, exactly
    measure(Eigen::Vector3f::Unit(axis));
  return smallest;
}

/// Whether all corners of a bin are within the middle of the image.
bool isInSight(const Bin& bin, const Eigen::Isometry3d& T_camera_bin, const PinholeCamera& camera)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d side((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5, corner >> 2);
    const Eigen::Vector3d p_bin = side.cwiseProduct(bin.size_m);
    const Eigen::Vector3f p_camera = (T_camera_bin * p_bin).cast<float>();
    if (!(p_camera.z() > 0)) return false;
    const Eigen::Vector2f away = camera.project(p_camera) - Eigen::Vector2f(camera.cx, camera.cy);
    if (std::abs(away.x()) > kImageShare / 2 * camera.width) return false;
    if (std::abs(away.y()) > kImageShare / 2 * camera.height) return false;
  }
  return true;
}
}  // namespace

double meanShadow(const TriangleMesh& part)
{
  const Ball ball = ballAround(part);
  const RayCaster caster({{&part, Eigen::Isometry3d::Identity()}});
  double sum = 0;
  for (int k = 0; k < kDirections; ++k)
    sum += shadow(caster, ball, evenDirection(k, kDirections));
  return sum / kDirections;
}

Bin binFor(const TriangleMesh& part, int count)
{
  const double hidden_m2 = meanShadow(part);
  if (!(hidden_m2 > 0)) throw std::invalid_argument("the part has no surface: give another mesh");
  const double size_m = meshDiameter(part);
  const double width =
      std::max(kMinSide_rel * size_m, std::sqrt(count * hidden_m2 / kShadowShare / kSideRatio));
  Bin bin;
  bin.size_m = {kSideRatio * width, width, kLayers * smallestWidth(part) + kFreeWall_rel * size_m};
  return bin;
}

CellSettings cellFor(const TriangleMesh& part, int count, const DepthSensor& sensor)
{
  CellSettings settings;
  settings.sensor = sensor;
  settings.bin = binFor(part, count);
  settings.bin_position_m.setZero();
  settings.camera_target_m = {0, 0, settings.bin.size_m.z()};
  for (double height_m = kNearest_m; height_m < kFarthest_m; height_m += kStep_m)
  {
    settings.camera_position_m =
        settings.camera_target_m +
        Eigen::Vector3d(-sensor.baseline_m / 2, -kSlope * height_m, height_m);
    const Eigen::Isometry3d T_camera_bin =
        lookAt(settings.camera_position_m, settings.camera_target_m).inverse();
    if (isInSight(settings.bin, T_camera_bin, sensor.camera)) return settings;
  }
  throw std::invalid_argument("the bin is too large for the camera: give fewer or smaller parts");
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/pose_information.hpp"

#include "ppf_bin_picking/core/boundary_table.hpp"
#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/outline.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kMinFacing = 0.25F;     // surfaces flatter to the line of sight are left out
constexpr float kReachRel = 0.04F;      // how far across the outline the surface is followed
constexpr float kInvisibleWeight = 10;  // more than any measurement holds
constexpr float kShadowWeight = 0.3F;   // of an end beyond which nothing was measured

void addSurface(const RangeImage& image, const RenderedPart& view, const Eigen::Vector3f& center,
                float lever_m, float gate_m, float min_normal_cosine, Matrix6f& sum)
{
  float count = 0;
  for (int row = 0; row < view.height; ++row)
    for (int column = 0; column < view.width; ++column)
    {
      const float depth_m = view.depthAt(column, row);
      if (depth_m == 0) continue;
      const std::size_t index = image.index(view.left + column, view.top + row);
      const Eigen::Vector3f ray = image.camera.ray(static_cast<float>(view.left + column),
                                                   static_cast<float>(view.top + row));
      Eigen::Vector3f normal =
          view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
      if (normal.dot(ray) > 0) normal = -normal;
      const float facing = -normal.dot(ray) / ray.norm();
      if (facing < kMinFacing) continue;
      const float z = image.depth[index];
      const float behind_m = (z - depth_m) * ray.norm() * facing;
      if (z > 0 && behind_m < -gate_m) continue;  // hidden
      ++count;
      if (z == 0 || behind_m > gate_m || !image.in_roi[index]) continue;
      if (!image.normals[index].isZero() && image.normals[index].dot(normal) < min_normal_cosine)
        continue;
      const Vector6f j = motionJacobian((ray * depth_m - center) / lever_m, normal);
      sum += j * j.transpose();
    }
  sum /= std::max(1.0F, count);
}

void addOutline(const RangeImage& image, const RenderedPart& view, const Eigen::Vector3f& center,
                float diameter_m, float gate_m, Matrix6f& sum)
{
  const float reach = kReachRel * diameter_m * image.camera.fx / center.z();
  const int reach_px = std::clamp(static_cast<int>(std::lround(reach)), 3, kOutlineReach_px);
  float count = 0;
  for (const OutlinePoint& point :
       outlineOf(view, image.camera, boundaryJump(diameter_m), reach_px, 1))
  {
    const OutlineEnd end = matchOutline(image, point, point.point, gate_m, reach_px).end;
    if (end == OutlineEnd::kHidden) continue;
    ++count;
    if (end != OutlineEnd::kBehind && end != OutlineEnd::kMissing) continue;
    const Eigen::Vector3f direction(point.direction.x(), point.direction.y(), 0);
    const Vector6f j = motionJacobian((point.point - center) / (kLeverRel * diameter_m), direction);
    sum += (end == OutlineEnd::kBehind ? 1.0F : kShadowWeight) * j * j.transpose();
  }
  sum /= std::max(1.0F, count);
}
}  // namespace

Vector6f motionJacobian(const Eigen::Vector3f& arm, const Eigen::Vector3f& direction)
{
  // Spelt out: GCC 12 warns of Eigen's vectorised cross product.
  Vector6f jacobian;
  jacobian << arm.y() * direction.z() - arm.z() * direction.y(),
      arm.z() * direction.x() - arm.x() * direction.z(),
      arm.x() * direction.y() - arm.y() * direction.x(), direction;
  return jacobian;
}

Eigen::Isometry3f moved(const Eigen::Isometry3f& T_camera_model, const Vector6f& step,
                        const Eigen::Vector3f& center, float lever_m)
{
  const Eigen::Vector3f turn = step.head<3>() / lever_m;
  const float angle = turn.norm();
  const Eigen::Matrix3f rotation = angle > 0
                                       ? Eigen::AngleAxisf(angle, turn / angle).toRotationMatrix()
                                       : Eigen::Matrix3f::Identity();
  Eigen::Isometry3f result;
  const Eigen::Matrix3f turned = rotation * T_camera_model.linear();
  result.linear() = Eigen::Quaternionf(turned).normalized().toRotationMatrix();
  result.translation() =
      center + rotation * (T_camera_model.translation() - center) + step.tail<3>();
  result.makeAffine();
  return result;
}

std::vector<Vector6f> invisibleMotions(const PpfModel& model,
                                       const Eigen::Isometry3f& T_camera_model)
{
  if (!model.symmetries().revolution()) return {};
  const SymmetryAxis& line = *model.symmetries().revolution();
  const Eigen::Vector3f center = T_camera_model * model.data().center;
  const Eigen::Vector3f arm_m = center - T_camera_model * line.point.cast<float>();
  const Eigen::Vector3f arm = arm_m / (kLeverRel * static_cast<float>(model.diameter()));
  std::vector<Eigen::Vector3f> axes = {T_camera_model.linear() * line.axis.cast<float>()};
  if (model.symmetries().sphere())
    axes = {Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitZ()};
  std::vector<Vector6f> motions;
  for (const Eigen::Vector3f& axis : axes)
  {
    Vector6f motion;
    motion << axis.x(), axis.y(), axis.z(), motionJacobian(axis, arm).head<3>();
    motions.emplace_back(motion.normalized());
  }
  return motions;
}
float PoseInformation::hold(const PpfModel& model, const Eigen::Isometry3f& T_camera_model) const
{
  Matrix6f matrix = surface + outline;
  for (const Vector6f& motion : invisibleMotions(model, T_camera_model))
    matrix += kInvisibleWeight * motion * motion.transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix6f>(matrix, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

PoseInformation gatherInformation(const RangeImage& image, const PpfModel& model,
                                  const Eigen::Isometry3f& T_camera_model,
                                  const DetectorConfig& config)
{
  RenderedPart view;
  renderPart(model.renderable(), T_camera_model, image.camera, view);
  const auto diameter_m = static_cast<float>(model.diameter());
  const auto gate_m = static_cast<float>(depthGate(image, diameter_m, config));
  const Eigen::Vector3f center = T_camera_model * model.data().center;
  PoseInformation information;
  addSurface(image, view, center, kLeverRel * diameter_m, gate_m,
             std::cos(static_cast<float>(config.normal_gate_rad)), information.surface);
  addOutline(image, view, center, diameter_m, gate_m, information.outline);
  return information;
}
}  // namespace ppf_bin_picking

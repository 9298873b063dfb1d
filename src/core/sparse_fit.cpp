#include "ppf_bin_picking/core/sparse_fit.hpp"

#include "ppf_bin_picking/core/alignment.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr int kSteps = 6;
constexpr std::size_t kSamples = 200;   // facing the camera, about
constexpr float kFirstGateRel = 0.10F;  // of the diameter
constexpr float kLastGateRel = 0.03F;   // of the diameter
constexpr float kMinNormalCosine = 0.7F;
constexpr float kMinFacing = 0.25F;     // surfaces flatter to the line of sight are left out
constexpr float kLookedThrough = 2.0F;  // weights of contradictions
constexpr float kWrongNormal = 1.0F;
constexpr float kMissing = 0.4F;
// Of the mean of the diagonal. Strong, as without the outline nothing else keeps different poses
// from sliding along their faces into one.
constexpr float kDamping = 0.1F;

/// A pose about the part's centre.
struct CenteredPose
{
  Eigen::Matrix3f rotation;
  Eigen::Vector3f center;  ///< Camera frame [m].
};

/// Some of the model's samples that face the camera, by index.
void chooseFacing(const PpfModelData& model, const CenteredPose& pose,
                  std::vector<std::uint32_t>& chosen)
{
  chosen.clear();
  // about a third of a part's samples face the camera
  const std::size_t stride = std::max<std::size_t>(1, model.points.size() / (3 * kSamples));
  for (std::size_t i = 0; i < model.points.size(); i += stride)
  {
    const Eigen::Vector3f p = pose.rotation * model.points[i] + pose.center;
    if (-p.dot(pose.rotation * model.normals[i]) > kMinFacing * p.norm())
      chosen.push_back(static_cast<std::uint32_t>(i));
  }
}

/// One step of point-to-plane ICP. False where too little is seen of the part.
bool step(const ImageArrays& image, const PointArrays& samples, float lever_m, float gate_m,
          CenteredPose& pose)
{
  Eigen::Isometry3f T_camera_samples = Eigen::Isometry3f::Identity();
  T_camera_samples.linear() = pose.rotation;
  T_camera_samples.translation() = pose.center;
  NormalEquations equations = alignmentOf(
      samples, image, T_camera_samples,
      {{pose.center.x(), pose.center.y(), pose.center.z()}, lever_m, gate_m, kMinNormalCosine});
  if (!(equations.weight > 6)) return false;
  Matrix6f& matrix = equations.matrix;
  matrix.diagonal().array() += kDamping * matrix.trace() / 6;
  const Vector6f motion = matrix.ldlt().solve(equations.right_side);
  const Eigen::Vector3f turn = motion.head<3>() / lever_m;
  const float angle = turn.norm();
  if (angle > 0)
    pose.rotation = Eigen::Quaternionf(Eigen::AngleAxisf(angle, turn / angle) * pose.rotation)
                        .normalized()
                        .toRotationMatrix();
  pose.center += motion.tail<3>();
  return true;
}

/// What the samples say of a pose.
float balanceOf(const RangeImage& image, const PpfModelData& model,
                const std::vector<std::uint32_t>& chosen, float gate_m, float min_normal_cosine,
                const CenteredPose& pose)
{
  float balance = 0;
  for (const std::uint32_t i : chosen)
  {
    const Eigen::Vector3f p = pose.rotation * model.points[i] + pose.center;
    const Eigen::Vector3f normal = pose.rotation * model.normals[i];
    int u, v;
    if (!image.camera.pixelOf(p, u, v)) continue;
    const std::size_t pixel = image.index(u, v);
    const float z = image.depth[pixel];
    if (z == 0)
    {
      balance -= kMissing;
      continue;
    }
    const float behind_m = normal.dot(p - image.point(u, v));
    if (behind_m < -gate_m) continue;  // hidden, perhaps by the part itself
    if (behind_m > gate_m)
      balance -= kLookedThrough;
    else if (!image.normals[pixel].isZero() && image.normals[pixel].dot(normal) < min_normal_cosine)
      balance -= kWrongNormal;
    else if (image.in_roi[pixel])
      balance += 1;
  }
  return balance / static_cast<float>(std::max<std::size_t>(1, chosen.size()));
}
}  // namespace

SparseFit fitSparsely(const RangeImage& image, const PpfModel& model,
                      const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config)
{
  std::vector<std::uint32_t> chosen;
  const PpfModelData& data = model.data();
  CenteredPose pose{T_camera_model.linear(), T_camera_model * data.center};
  chooseFacing(data, pose, chosen);
  PointArrays samples;
  for (const std::uint32_t i : chosen)
    samples.add(data.points[i].data(), data.normals[i].data());
  const ImageArrays arrays = arraysOf(image);
  const int steps = std::min(kSteps, config.icp_iterations);
  for (int i = 0; i < steps; ++i)
  {
    const float progress = static_cast<float>(i) / static_cast<float>(kSteps - 1);
    const float gate_rel = kFirstGateRel * std::pow(kLastGateRel / kFirstGateRel, progress);
    if (!step(arrays, samples, kLeverRel * data.diameter_m, gate_rel * data.diameter_m, pose))
      break;
  }
  chooseFacing(data, pose, chosen);
  SparseFit fit;
  fit.balance = balanceOf(image, data, chosen,
                          1.5F * static_cast<float>(config.depth_gate_rel) * data.diameter_m,
                          std::cos(static_cast<float>(config.normal_gate_rad)), pose);
  fit.T_camera_model.linear() = pose.rotation;
  fit.T_camera_model.translation() = pose.center - pose.rotation * data.center;
  return fit;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/sparse_fit.hpp"

#include "ppf_bin_picking/core/alignment.hpp"
#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"
#include "ppf_bin_picking/core/sample_balance.hpp"

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
// Of the mean of the diagonal. Strong, as without the outline nothing else keeps different poses
// from sliding along their faces into one.
constexpr float kDamping = 0.1F;

/// Some of the model's samples that face the camera, about the part's centre.
PointArrays facingSamples(const PpfModelData& model, const Eigen::Isometry3f& T_camera_samples)
{
  PointArrays samples;
  // about a third of a part's samples face the camera
  const std::size_t stride = std::max<std::size_t>(1, model.points.size() / (3 * kSamples));
  for (std::size_t i = 0; i < model.points.size(); i += stride)
    if (facesCamera(T_camera_samples * model.points[i],
                    T_camera_samples.linear() * model.normals[i]))
      samples.add(model.points[i].data(), model.normals[i].data());
  return samples;
}

/// One step of point-to-plane ICP. False where too little is seen of the part.
bool step(const ImageArrays& image, const PointArrays& samples, float lever_m, float gate_m,
          Eigen::Isometry3f& T_camera_samples)
{
  const Eigen::Vector3f center = T_camera_samples.translation();
  NormalEquations equations =
      alignmentOf(samples, image, T_camera_samples,
                  {{center.x(), center.y(), center.z()}, lever_m, gate_m, kMinNormalCosine});
  if (!(equations.weight > 6)) return false;
  Matrix6f& matrix = equations.matrix;
  matrix.diagonal().array() += kDamping * matrix.trace() / 6;
  const Vector6f motion = matrix.ldlt().solve(equations.right_side);
  T_camera_samples = moved(T_camera_samples, motion, center, lever_m);
  return true;
}
}  // namespace

SparseFit fitSparsely(const RangeImage& image, const PpfModel& model,
                      const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config)
{
  const PpfModelData& data = model.data();
  Eigen::Isometry3f T_camera_samples = T_camera_model * Eigen::Translation3f(data.center);
  const PointArrays samples = facingSamples(data, T_camera_samples);
  const ImageArrays arrays = arraysOf(image);
  const int steps = std::min(kSteps, config.icp_iterations);
  for (int i = 0; i < steps; ++i)
  {
    const float progress = static_cast<float>(i) / static_cast<float>(kSteps - 1);
    const float gate_rel = kFirstGateRel * std::pow(kLastGateRel / kFirstGateRel, progress);
    if (!step(arrays, samples, kLeverRel * data.diameter_m, gate_rel * data.diameter_m,
              T_camera_samples))
      break;
  }
  const float gate_m = 1.5F * static_cast<float>(depthGate(image, data.diameter_m, config));
  SparseFit fit;
  fit.balance =
      sampleBalance(image, facingSamples(data, T_camera_samples), T_camera_samples, gate_m, config);
  fit.T_camera_model = T_camera_samples * Eigen::Translation3f(-data.center);
  return fit;
}
}  // namespace ppf_bin_picking

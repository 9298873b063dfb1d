#include "ppf_bin_picking/core/pose_refinement.hpp"

#include "ppf_bin_picking/core/alignment.hpp"
#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/outline.hpp"
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
constexpr int kStepsPerLook = 4;  // the visible surface is rendered anew after so many steps
constexpr std::size_t kSurfacePoints = 500;  // of the visible surface, about
constexpr int kOutlineStride = 2;            // every so many pixels of the outline
constexpr int kLastOutlineReach_px = 5;
constexpr float kOutlineWeight = 0.5F;  // of an outline pixel, relative to a surface point
constexpr float kShadowWeight = 0.3F;   // ... beyond which nothing was measured
constexpr float kFullPull_px = 2.0F;    // farther ends of the surface pull no more than these
constexpr float kFirstGateRel = 0.10F;  // of the diameter
constexpr float kNarrower = 0.7F;       // each gate that is tried, relative to the one before
constexpr float kNearShare = 0.85F;     // of the weight within the widest gate
constexpr float kMinNormalCosine = 0.7F;
constexpr float kMinFacing = 0.15F;      // surfaces flatter to the line of sight are left out
constexpr float kWeakDirection = 2e-3F;  // eigenvalue below which a direction is not held
constexpr float kConvergedRel = 1e-5F;   // step, relative to the diameter
constexpr float kPriorShare = 1e-3F;
// Settling: the outline is found in whole pixels, so that whole steps jump back and forth.
constexpr int kSettlingSteps = 8;
constexpr float kSettlingShare = 0.5F;  // of each step
constexpr float kSettlingRel = 0.01F;   // of the diameter: half of what verification tells apart

/// What the camera sees of a free part at a pose.
struct VisiblePart
{
  RenderedPart view;
  PointArrays surface;                          ///< About kSurfacePoints, evenly, mesh frame [m].
  std::vector<OutlinePoint> outline;            ///< Points as seen from the pose of rendering.
  std::vector<Eigen::Vector3f> outline_points;  ///< The outline's points, mesh frame [m].
};

void seeFrom(const PpfModel& model, const Eigen::Isometry3f& T_camera_model,
             const PinholeCamera& camera, int reach_px, VisiblePart& part)
{
  RenderedPart& view = part.view;
  renderPart(model.renderable(), T_camera_model, camera, view);
  part.surface.resize(0);
  const auto covered = static_cast<std::size_t>(
      std::count_if(view.depth.begin(), view.depth.end(), [](float z) { return z > 0; }));
  const int stride =
      std::max(1, static_cast<int>(std::sqrt(static_cast<float>(covered) / kSurfacePoints)));
  const Eigen::Isometry3f T_model_camera = T_camera_model.inverse(Eigen::Isometry);
  for (int row = stride / 2; row < view.height; row += stride)
    for (int column = stride / 2; column < view.width; column += stride)
    {
      const float z = view.depthAt(column, row);
      if (z == 0) continue;
      const Eigen::Vector3f ray =
          camera.ray(static_cast<float>(view.left + column), static_cast<float>(view.top + row));
      Eigen::Vector3f normal =
          view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
      if (normal.dot(ray) > 0) normal = -normal;
      if (-normal.dot(ray) < kMinFacing * ray.norm()) continue;
      const Eigen::Vector3f point = T_model_camera * (z * ray);
      const Eigen::Vector3f normal_model = T_model_camera.linear() * normal;
      part.surface.add(point.data(), normal_model.data());
    }
  part.outline = outlineOf(view, camera, boundaryJump(static_cast<float>(model.diameter())),
                           reach_px, kOutlineStride);
  part.outline_points.clear();
  for (const OutlinePoint& point : part.outline)
    part.outline_points.push_back(T_model_camera * point.point);
}

/// The step that solves the equations, without its part along directions that the data does not
/// hold.
Vector6f stepOf(const NormalEquations& equations)
{
  const Eigen::SelfAdjointEigenSolver<Matrix6f> solver(equations.matrix / equations.weight);
  Vector6f along = solver.eigenvectors().transpose() * equations.right_side / equations.weight;
  for (int i = 0; i < 6; ++i)
  {
    const float held = solver.eigenvalues()(i);
    along(i) = held > kWeakDirection ? along(i) / (held + kPriorShare) : 0.0F;
  }
  return solver.eigenvectors() * along;
}

/// Adds what the outline says: across it the part should end where the measured surface ends.
void addOutline(const RangeImage& image, const VisiblePart& part,
                const Eigen::Isometry3f& T_camera_model, const Eigen::Vector3f& center,
                float lever_m, float gate_m, int reach_px, NormalEquations& equations)
{
  for (std::size_t i = 0; i < part.outline.size(); ++i)
  {
    const Eigen::Vector3f p = T_camera_model * part.outline_points[i];
    const OutlineMatch match = matchOutline(image, part.outline[i], p, gate_m, reach_px);
    if (match.end == OutlineEnd::kGoesOn || match.end == OutlineEnd::kHidden) continue;
    // What is missing within the outline may be lost of the part: flanks and shiny edges are.
    if (match.end == OutlineEnd::kMissing && match.offset_px < 0) continue;
    const auto offset_px = static_cast<float>(match.offset_px);
    const float huber = kFullPull_px / std::max(kFullPull_px, std::abs(offset_px));
    const float weight = match.end == OutlineEnd::kMissing ? kShadowWeight : kOutlineWeight;
    const Eigen::Vector3f direction(part.outline[i].direction.x(), part.outline[i].direction.y(),
                                    0);
    equations.add(motionJacobian((p - center) / lever_m, direction),
                  offset_px * p.z() / image.camera.fx, weight * huber);
  }
}

/// What steps have in common.
struct Stepper
{
  Stepper(const RangeImage& given_image, const PpfModel& given_model, const DetectorConfig& config)
      : image(given_image),
        model(given_model),
        arrays(arraysOf(given_image)),
        diameter_m(given_model.data().diameter_m),
        last_gate_m(1.5F * static_cast<float>(depthGate(given_image, diameter_m, config)))
  {
  }

  /// Looks at the part from where it is now.
  void see(const Eigen::Isometry3f& pose, int reach_px)
  {
    seeFrom(model, pose, image.camera, reach_px, part);
  }

  /// The weight of the surface's measurements within a gate.
  float weightWithin(float gate_m, const Eigen::Isometry3f& pose) const
  {
    const Eigen::Vector3f center = pose * model.data().center;
    const AlignmentTerms terms{
        {center.x(), center.y(), center.z()}, kLeverRel * diameter_m, gate_m, kMinNormalCosine};
    return alignmentOf(part.surface, arrays, pose, terms).weight;
  }

  /// The gate to begin with: narrow where most of what a wide one would take in is near already,
  /// as a wide one lets neighbours turn a pose that was right.
  float firstGate(const Eigen::Isometry3f& pose) const
  {
    float gate_m = kFirstGateRel * diameter_m;
    const float enough = kNearShare * weightWithin(gate_m, pose);
    for (float narrower_m = gate_m; narrower_m > last_gate_m; gate_m = narrower_m)
    {
      narrower_m = std::max(last_gate_m, kNarrower * gate_m);
      if (weightWithin(narrower_m, pose) < enough) break;
    }
    return gate_m;
  }

  /// Takes a share of one step. False, and no step, where too little is seen of the part.
  bool step(float gate_m, int reach_px, float share, Eigen::Isometry3f& pose)
  {
    const float lever_m = kLeverRel * diameter_m;
    const Eigen::Vector3f center = pose * model.data().center;
    NormalEquations equations =
        alignmentOf(part.surface, arrays, pose,
                    {{center.x(), center.y(), center.z()}, lever_m, gate_m, kMinNormalCosine});
    if (!(equations.weight > 6)) return false;
    addOutline(image, part, pose, center, lever_m, last_gate_m, reach_px, equations);
    const Vector6f whole = stepOf(equations);
    pose = moved(pose, share * whole, center, lever_m);
    last_step_m = whole.norm();
    return true;
  }

  const RangeImage& image;
  const PpfModel& model;
  ImageArrays arrays;
  VisiblePart part;
  float diameter_m;
  float last_gate_m;
  float last_step_m = 0;  ///< With turns in levers.
};
}  // namespace

void refineByOneLook(const RangeImage& image, const PpfModel& model, const DetectorConfig& config,
                     Refinement& refinement)
{
  Stepper stepper(image, model, config);
  const float last_gate_m = stepper.last_gate_m;
  Eigen::Isometry3f& pose = refinement.T_camera_model;
  const int first_step = refinement.steps;
  const int end = std::min(first_step + kStepsPerLook, config.icp_iterations);
  for (int& i = refinement.steps; i < end; ++i)
  {
    const float progress =
        static_cast<float>(i) / static_cast<float>(std::max(1, config.icp_iterations - 1));
    const int reach_px =
        kOutlineReach_px - static_cast<int>(progress * (kOutlineReach_px - kLastOutlineReach_px));
    if (i == first_step) stepper.see(pose, reach_px);
    if (i == 0) refinement.first_gate_m = stepper.firstGate(pose);
    const float first_gate_m = refinement.first_gate_m;
    const float share = i + kStepsPerLook < config.icp_iterations ? 1.0F : 0.5F;
    const float gate_m =
        std::max(last_gate_m, first_gate_m * std::pow(last_gate_m / first_gate_m, 1.5F * progress));
    refinement.done =
        !stepper.step(gate_m, reach_px, share, pose) ||
        (gate_m == last_gate_m && stepper.last_step_m < kConvergedRel * stepper.diameter_m);
    if (refinement.done) break;
  }
  refinement.done = refinement.done || refinement.steps == config.icp_iterations;
  if (first_step == 0 && end > 0)
    refinement.balance = sampleBalance(image, stepper.part.surface, pose, last_gate_m, config);
}

Eigen::Isometry3f refinePose(const RangeImage& image, const PpfModel& model,
                             const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config)
{
  Refinement refinement{T_camera_model};
  while (!refinement.done)
    refineByOneLook(image, model, config, refinement);
  return refinement.T_camera_model;
}

Eigen::Isometry3f settlePose(const RangeImage& image, const PpfModel& model,
                             const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config)
{
  Stepper stepper(image, model, config);
  Eigen::Isometry3f pose = T_camera_model;
  for (int i = 0; i < kSettlingSteps && config.icp_iterations > 0; ++i)
  {
    if (i % kStepsPerLook == 0) stepper.see(pose, kLastOutlineReach_px);
    if (!stepper.step(stepper.last_gate_m, kLastOutlineReach_px, kSettlingShare, pose)) break;
  }
  const Eigen::Vector3f& center = model.data().center;
  const float shift_m = (pose * center - T_camera_model * center).norm();
  const Eigen::AngleAxisf turn(
      Eigen::Matrix3f(T_camera_model.linear().transpose() * pose.linear()));
  const float farthest_m = shift_m + turn.angle() * stepper.diameter_m / 2;
  return farthest_m < kSettlingRel * stepper.diameter_m ? pose : T_camera_model;
}
}  // namespace ppf_bin_picking

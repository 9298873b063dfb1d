#include "ppf_bin_picking/ros/result_merging.hpp"

#include "ppf_bin_picking/core/detection_message.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/percent.hpp"
#include "ppf_bin_picking/core/pinhole_camera.hpp"
#include "ppf_bin_picking/core/pose_report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::ClusterShare;
using ppf_bin_picking::DetectedPose;
using ppf_bin_picking::DetectionResult;
using ppf_bin_picking::DetectionStatus;
using ppf_bin_picking::MismatchingRegion;
using ppf_bin_picking::percent;
using ppf_bin_picking::PinholeCamera;
using ppf_bin_picking::PpfModel;
using ppf_bin_picking::reliablePosesInWords;
using ppf_bin_picking::RenderedPart;
using ppf_bin_picking::UnreliableReason;

constexpr double kMaxSharedSurface = 0.2;
constexpr double kGateRel = 0.03;          // of the smaller diameter: nearer surfaces are one
constexpr double kPixelsPerDiameter = 60;  // of the smaller part
constexpr double kMostPixels = 1000;       // across the larger part

template <class Element>
void append(std::vector<Element>& to, std::vector<Element>& from)
{
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Adds what the next detection found; clusters are counted on.
void add(DetectionResult& all, DetectionResult&& next)
{
  const auto clusters_before = static_cast<std::int32_t>(all.clusters.size());
  const auto shift = [&](std::int32_t& cluster)
  { cluster = cluster < 0 ? cluster : cluster + clusters_before; };
  for (DetectedPose& pose : next.poses)
    shift(pose.cluster);
  for (auto& hypothesis : next.distribution)
    shift(hypothesis.cluster);
  append(all.poses, next.poses);
  append(all.regions, next.regions);
  append(all.distribution, next.distribution);
  append(all.clusters, next.clusters);
  append(all.stages, next.stages);
  all.seconds += next.seconds;
  if (next.status == DetectionStatus::kTimeLimit) all.status = next.status;
}

/// A camera at the clouds' origin that sees a part and all parts that may touch it.
PinholeCamera cameraOn(const PpfModel& part, const Eigen::Isometry3d& T_cloud_part,
                       const double reach_m, const double pixel_m)
{
  const Eigen::Vector3d center = T_cloud_part * part.data().center.cast<double>();
  PinholeCamera camera;
  camera.width = camera.height = static_cast<int>(std::ceil(2 * reach_m / pixel_m));
  camera.fx = camera.fy = static_cast<float>(center.z() / pixel_m);
  camera.cx = static_cast<float>(camera.width / 2.0 - center.x() / pixel_m);
  camera.cy = static_cast<float>(camera.height / 2.0 - center.y() / pixel_m);
  return camera;
}

std::ptrdiff_t pixelsOf(const RenderedPart& view)
{
  return std::count_if(view.depth.begin(), view.depth.end(), [](float z_m) { return z_m > 0; });
}

/// Pixels in which both views show a surface in the same depth.
std::ptrdiff_t pixelsOfBoth(const RenderedPart& a, const RenderedPart& b, const float gate_m)
{
  std::ptrdiff_t both = 0;
  for (int row = 0; row < a.height; ++row)
    for (int column = 0; column < a.width; ++column)
    {
      const int column_b = column + a.left - b.left, row_b = row + a.top - b.top;
      if (column_b < 0 || row_b < 0 || column_b >= b.width || row_b >= b.height) continue;
      const float z_a_m = a.depthAt(column, row), z_b_m = b.depthAt(column_b, row_b);
      if (z_a_m > 0 && z_b_m > 0 && std::abs(z_a_m - z_b_m) < gate_m) ++both;
    }
  return both;
}

/// The region of a pose that a better one of another detection turns down.
MismatchingRegion overlapOf(const DetectedPose& pose, const PpfModel& model,
                            const DetectionResult& all, const double shared)
{
  ClusterShare share;
  if (pose.cluster >= 0)
    share.hypotheses = all.clusters[static_cast<std::size_t>(pose.cluster)].hypotheses;
  return regionOf(
      pose, model,
      {UnreliableReason::kOverlap, "a better pose of a part with other settings explains " +
                                       percent(shared) + " of the same surface"},
      share);
}

/// @param all  Its poses are sorted.
/// @param detection_of_model  Index of the detection that looked for the model.
void resolveOverlaps(DetectionResult& all, const std::vector<const PpfModel*>& models,
                     const std::vector<std::size_t>& detection_of_model)
{
  for (std::size_t i = 0; i < all.poses.size(); ++i)
  {
    DetectedPose& pose = all.poses[i];
    for (std::size_t j = 0; j < i && pose.reliable; ++j)
    {
      const DetectedPose& better = all.poses[j];
      if (!better.reliable || detection_of_model[better.model] == detection_of_model[pose.model])
        continue;
      const double shared = sharedSurface(*models[pose.model], pose.T_cloud_model,
                                          *models[better.model], better.T_cloud_model);
      if (shared <= kMaxSharedSurface) continue;
      pose.reliable = false;
      pose.reason = UnreliableReason::kOverlap;
      all.regions.push_back(overlapOf(pose, *models[pose.model], all, shared));
    }
  }
}

/// All detections looked into the same region.
void setStatus(DetectionResult& all)
{
  if (all.status == DetectionStatus::kRoiEmpty) return;
  const std::size_t reliable = reliablePoses(all);
  if (all.status == DetectionStatus::kTimeLimit)
  {
    all.message = "the time limit ended the search with " + reliablePosesInWords(reliable) +
                  ": raise time_limit_s to see all";
    return;
  }
  all.status = reliable == 0 ? DetectionStatus::kNoPickablePose : DetectionStatus::kOk;
  all.message = searchMessage(all);
}
}  // namespace

double sharedSurface(const PpfModel& a, const Eigen::Isometry3d& T_camera_a, const PpfModel& b,
                     const Eigen::Isometry3d& T_camera_b)
{
  const auto [smaller_m, larger_m] = std::minmax({a.diameter(), b.diameter()});
  const double pixel_m = std::max(smaller_m / kPixelsPerDiameter, larger_m / kMostPixels);
  const double reach_m = a.diameter() + 2 * b.diameter();
  const Eigen::Vector3d apart =
      T_camera_a * a.data().center.cast<double>() - T_camera_b * b.data().center.cast<double>();
  if (apart.norm() > a.diameter() + b.diameter()) return 0;
  const PinholeCamera camera = cameraOn(a, T_camera_a, reach_m, pixel_m);
  RenderedPart view_a, view_b;
  renderPart(a.renderable(), T_camera_a.cast<float>(), camera, view_a);
  renderPart(b.renderable(), T_camera_b.cast<float>(), camera, view_b);
  const std::ptrdiff_t seen = std::min(pixelsOf(view_a), pixelsOf(view_b));
  const auto gate_m = static_cast<float>(kGateRel * smaller_m);
  return seen == 0 ? 0
                   : static_cast<double>(pixelsOfBoth(view_a, view_b, gate_m)) /
                         static_cast<double>(seen);
}

DetectionResult merged(std::vector<DetectionResult> results,
                       const std::vector<const PpfModel*>& models)
{
  DetectionResult all = std::move(results.front());
  if (results.size() == 1) return all;
  std::vector<std::size_t> detection_of_model(models.size(), 0);
  for (std::size_t k = 1; k < results.size(); ++k)
  {
    for (const DetectedPose& pose : results[k].poses)
      detection_of_model[pose.model] = k;
    add(all, std::move(results[k]));
  }
  sortResult(all);
  resolveOverlaps(all, models, detection_of_model);
  sortResult(all);
  setStatus(all);
  return all;
}
}  // namespace ppf_bin_picking_ros

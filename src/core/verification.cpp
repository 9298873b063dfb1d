#include "ppf_bin_picking/core/verification.hpp"

#include "ppf_bin_picking/core/depth_noise.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr float kUnseenFacing =
    0.25F;  // cosine to the line of sight below which a surface need not be seen
constexpr float kSeenFacing = 0.6F;  // ... from which on it counts in full
constexpr float kRingRel = 0.04F;  // width of the ring along the outline where contradictions fade
constexpr float kEdgeReachRel = 0.04F;  // how far across the outline the surface is followed
constexpr float kStepGates = 0.5F;      // of the depth gate: smaller steps leave a normal as it is
constexpr float kPierceGates = 0.5F;    // ... and smaller rises towards the camera are no step
constexpr float kEvenGates =
    0.25F;  // of the depth gate: how far a plane's next pixel may lie beside it
constexpr double kMissingWeight = 0.4;    // of a contradiction
constexpr double kMissingBalance = 0.56;  // ... in the balance of evidence
constexpr double kHiddenWeight = 0.3;     // likewise
constexpr double kEdgeWeight = 4.0;       // of a broken outline pixel, in pixels of surface

/// One pixel of the rendered part.
struct ModelPixel
{
  Eigen::Vector3f ray;     ///< z = 1.
  Eigen::Vector3f point;   ///< [m]
  Eigen::Vector3f normal;  ///< Towards the camera.
};

class Comparison
{
public:
  Comparison(const RangeImage& image, const RenderedPart& view, const DetectorConfig& config,
             float diameter_m)
      : image_(image),
        view_(view),
        gate_m_(static_cast<float>(depthGate(image, diameter_m, config))),
        jump_m_(boundaryJump(diameter_m)),
        normal_radius_px_(image.normal_radius_px),
        min_normal_cosine_(std::cos(static_cast<float>(config.normal_gate_rad)))
  {
    const float depth_m =
        view.width > 0 ? *std::max_element(view.depth.begin(), view.depth.end()) : 1.0F;
    const float diameter_px = diameter_m * image.camera.fx / depth_m;
    ring_px_ = std::max(1, static_cast<int>(std::lround(kRingRel * diameter_px)));
    edge_reach_px_ =
        std::clamp(static_cast<int>(std::lround(kEdgeReachRel * diameter_px)), 3, kOutlineReach_px);
  }

  PoseEvidence run()
  {
    behind_m_.assign(view_.depth.size(), std::numeric_limits<float>::quiet_NaN());
    evidence_.confirmed.reserve(view_.depth.size() / 2);
    for (int row = 0; row < view_.height; ++row)
      for (int column = 0; column < view_.width; ++column)
        if (view_.depthAt(column, row) > 0) comparePixel(column, row);
    compareHidden();
    compareOutline();
    const auto count = static_cast<float>(evidence_.confirmed.size());
    if (count > 0) evidence_.rms_error_m = std::sqrt(squared_error_ / count);
    return std::move(evidence_);
  }

private:
  ModelPixel modelPixel(int column, int row) const
  {
    ModelPixel pixel;
    pixel.ray = image_.camera.ray(static_cast<float>(view_.left + column),
                                  static_cast<float>(view_.top + row));
    pixel.point = pixel.ray * view_.depthAt(column, row);
    pixel.normal =
        view_.normals[view_.triangle[static_cast<std::size_t>(row) * view_.width + column]];
    if (pixel.normal.dot(pixel.ray) > 0) pixel.normal = -pixel.normal;
    return pixel;
  }

  void comparePixel(int column, int row)
  {
    const std::size_t index = image_.index(view_.left + column, view_.top + row);
    const ModelPixel pixel = modelPixel(column, row);
    const float stretch = pixel.ray.norm();  // distance per depth
    const float facing = -pixel.normal.dot(pixel.ray) / stretch;
    const float weight =
        std::clamp((facing - kUnseenFacing) / (kSeenFacing - kUnseenFacing), 0.0F, 1.0F);
    const float z = image_.depth[index];
    const float behind_m = (z - view_.depthAt(column, row)) * stretch * std::max(facing, 0.3F);
    const Eigen::Vector3f& normal = image_.normals[index];
    if (z > 0) behind_m_[static_cast<std::size_t>(row) * view_.width + column] = behind_m;
    if (z > 0 && behind_m < -gate_m_)
    {
      evidence_.occluded += weight;
      return;
    }
    ++evidence_.visible_px;
    if (z == 0)
      evidence_.missing += doubt(column, row, weight);
    else if (behind_m > gate_m_)
      evidence_.looked_through += doubt(column, row, weight);
    else if (!normal.isZero() && normal.dot(pixel.normal) < min_normal_cosine_ &&
             isEven(column, row, pixel))
      evidence_.wrong_normal += doubt(column, row, weight);
    else if (!image_.in_roi[index])
      evidence_.outside += weight;
    else
      confirm(index, weight, behind_m);
  }

  /// True if the window of the image's plane fits sees one even piece of the part; over a crease or
  /// a small step its normal is none of the part's.
  bool isEven(int column, int row, const ModelPixel& middle) const
  {
    const int right = std::min(column + normal_radius_px_, view_.width - 1);
    const int bottom = std::min(row + normal_radius_px_, view_.height - 1);
    for (int r = std::max(row - normal_radius_px_, 0); r <= bottom; ++r)
      for (int c = std::max(column - normal_radius_px_, 0); c <= right; ++c)
      {
        if (view_.depthAt(c, r) == 0) continue;
        const ModelPixel other = modelPixel(c, r);
        if (other.normal.dot(middle.normal) < min_normal_cosine_ ||
            std::abs(middle.normal.dot(other.point - middle.point)) > kStepGates * gate_m_)
          return false;
      }
    return true;
  }

  void confirm(std::size_t index, float weight, float behind_m)
  {
    evidence_.confirmed.push_back({static_cast<std::uint32_t>(index), weight});
    evidence_.confirmed_weight += weight;
    squared_error_ += behind_m * behind_m;
  }

  /// The weight of a contradiction: near the outline sensors mix what lies before and behind.
  float doubt(int column, int row, float weight) const
  {
    const int distance_px = outlineDistance(view_, image_.camera, column, row, jump_m_, ring_px_);
    return weight * static_cast<float>(distance_px) / static_cast<float>(ring_px_);
  }

  /// Looks at the borders of what something hides: that is a step up from the part's surface,
  /// unless the measured surface passes through it.
  void compareHidden()
  {
    for (int row = 0; row < view_.height; ++row)
      for (int column = 0; column < view_.width; ++column)
      {
        const float hidden_m = behindAt(column, row);
        if (!(hidden_m < -gate_m_)) continue;
        bool beside_surface = false, passes = false;
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        {
          const float beside_m = behindAt(column + dc, row + dr);
          if (!(std::abs(beside_m) <= gate_m_)) continue;
          beside_surface = true;
          passes = passes || beside_m - hidden_m < kPierceGates * gate_m_ ||
                   isEvenCloud(column + dc, row + dr, column, row);
        }
        if (beside_surface) ++(passes ? evidence_.pierced : evidence_.stepped);
      }
  }

  /// True if the cloud at the second pixel is as deep as the first one's plane is there.
  bool isEvenCloud(int column, int row, int next_column, int next_row) const
  {
    const std::size_t index = image_.index(view_.left + column, view_.top + row);
    const std::size_t next = image_.index(view_.left + next_column, view_.top + next_row);
    const Eigen::Vector3f& normal = image_.normals[index];
    const auto ray_at = [&](int c, int r)
    {
      return image_.camera.ray(static_cast<float>(view_.left + c),
                               static_cast<float>(view_.top + r));
    };
    const float here = normal.dot(ray_at(column, row));
    const Eigen::Vector3f ray = ray_at(next_column, next_row);
    const float there = normal.dot(ray);
    if (!(here < 0 && there < 0)) return false;  // no normal, or none that tells
    const float expected_m = image_.depth[index] * here / there;
    return std::abs(image_.depth[next] - expected_m) * ray.norm() < kEvenGates * gate_m_;
  }

  /// How far the cloud is behind the part's surface [m]; NaN where one of them is not.
  float behindAt(int column, int row) const
  {
    if (column < 0 || row < 0 || column >= view_.width || row >= view_.height)
      return std::numeric_limits<float>::quiet_NaN();
    return behind_m_[static_cast<std::size_t>(row) * view_.width + column];
  }

  /// Follows the measured surface across the outline.
  void compareOutline()
  {
    for (const OutlinePoint& point : outlineOf(view_, image_.camera, jump_m_, edge_reach_px_, 1))
    {
      const OutlineEnd end = matchOutline(image_, point, point.point, gate_m_, edge_reach_px_).end;
      if (end == OutlineEnd::kHidden || end == OutlineEnd::kMissing) continue;
      const bool holds = end == OutlineEnd::kBehind;
      ++(holds ? evidence_.outline_held : evidence_.outline_broken);
      if (end == OutlineEnd::kGoesOn)
        evidence_.goes_on.push_back({pixelBeyond(point), point.direction});
      else
        addSlideStop(point.direction, holds ? evidence_.slide_held : evidence_.slide_broken);
    }
  }

  /// The pixel as far beyond the outline as it is followed, or the last one of the image.
  std::uint32_t pixelBeyond(const OutlinePoint& point) const
  {
    const Eigen::Vector2f at =
        image_.camera.project(point.point) + static_cast<float>(edge_reach_px_) * point.direction;
    const int u = std::clamp(static_cast<int>(std::lround(at.x())), 0, image_.camera.width - 1);
    const int v = std::clamp(static_cast<int>(std::lround(at.y())), 0, image_.camera.height - 1);
    return static_cast<std::uint32_t>(image_.index(u, v));
  }

  const RangeImage& image_;
  const RenderedPart& view_;
  float gate_m_;
  float jump_m_;
  int normal_radius_px_;
  float min_normal_cosine_;
  int edge_reach_px_ = 2;
  int ring_px_ = 1;
  std::vector<float> behind_m_;
  PoseEvidence evidence_;
  float squared_error_ = 0;
};
}  // namespace

void addSlideStop(const Eigen::Vector2f& outward, SlideStops& stops)
{
  for (std::size_t i = 0; i < stops.size(); ++i)
  {
    const auto angle =
        static_cast<float>(M_PI) * static_cast<float>(i) / static_cast<float>(stops.size());
    const float cosine = outward.dot(Eigen::Vector2f(std::cos(angle), std::sin(angle)));
    stops[i] += cosine * cosine * cosine * cosine;
  }
}

PoseEvidence gatherEvidence(const RangeImage& image, const PpfModel& model,
                            const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config)
{
  RenderedPart view;
  renderPart(model.renderable(), T_camera_model, image.camera, view);
  return Comparison(image, view, config, static_cast<float>(model.diameter())).run();
}

double poseScore(const PoseEvidence& evidence, double confirmed)
{
  const double against = evidence.looked_through + evidence.wrong_normal + evidence.outside +
                         kMissingWeight * evidence.missing +
                         kEdgeWeight * (evidence.outline_broken + evidence.pierced) +
                         evidence.confirmed_weight - confirmed;
  return confirmed > 0 ? confirmed / (confirmed + against) : 0.0;
}

double evidenceBalance(const PoseEvidence& evidence, double confirmed)
{
  const double claimed_by_others = evidence.confirmed_weight - confirmed;
  return confirmed - 3.0 * evidence.looked_through - 3.6 * evidence.wrong_normal -
         kMissingBalance * evidence.missing - kHiddenWeight * evidence.occluded -
         1.0 * evidence.outside - claimed_by_others -
         10.0 * (evidence.outline_broken + evidence.pierced) + 3.0 * evidence.outline_held;
}

double seenBalance(const PoseEvidence& evidence, double confirmed)
{
  return evidenceBalance(evidence, confirmed) + kHiddenWeight * evidence.occluded +
         kMissingBalance * evidence.missing;
}

double visibleFraction(const PoseEvidence& evidence)
{
  const double expected = evidence.expected();
  return expected > 0 ? expected / (expected + evidence.occluded) : 0.0;
}
}  // namespace ppf_bin_picking

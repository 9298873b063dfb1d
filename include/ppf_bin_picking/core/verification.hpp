/// @file What the cloud says of a pose: confirmed, contradicted, hidden.
#pragma once

#include "ppf_bin_picking/core/detector_config.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// Weight of outline pixels against slides, by the slide's direction over half a turn in the image.
using SlideStops = std::array<double, 8>;

/// Adds an outline pixel: it stops slides across it, weighed by the fourth power of the cosine.
/// @param outward  Across the outline, in the image, unit length.
void addSlideStop(const Eigen::Vector2f& outward, SlideStops& stops);

/// The pixels that a free part at the pose would cover, sorted by what was measured there. Sums of
/// weights: a pixel counts less the flatter the surface lies to the line of sight, as sensors see
/// little of such surfaces.
struct PoseEvidence
{
  /// A confirmed pixel.
  struct Pixel
  {
    std::uint32_t index;  ///< Into the image.
    float weight;         ///< In [0, 1].
  };
  /// Where the measured surface goes on beyond the outline.
  struct Continuation
  {
    std::uint32_t pixel;        ///< Just beyond, index into the image.
    Eigen::Vector2f direction;  ///< Out of the part, unit length.
  };
  std::vector<Pixel> confirmed;  ///< Surface and normal agree, inside the region.
  int visible_px = 0;            ///< All pixels that nothing in front hides, unweighted.
  double confirmed_weight = 0;   ///< Sum over confirmed.
  double looked_through = 0;     ///< The cloud lies behind the supposed surface.
  double wrong_normal = 0;       ///< A surface in the right place with another normal.
  double missing = 0;            ///< Nothing was measured.
  double occluded = 0;           ///< The cloud lies in front.
  double outside = 0;            ///< Explained by a surface outside the region of interest.
  double outline_held = 0;       ///< Outline pixels where the measured surface ends, too.
  double outline_broken =
      0;  ///< Outline pixels beyond which the surface goes on, or where it is absent.
  SlideStops slide_held{};            ///< Of outline_held.
  SlideStops slide_broken{};          ///< Of outline_broken, where the surface is absent.
  std::vector<Continuation> goes_on;  ///< The rest of outline_broken.
  double stepped = 0;  ///< Hidden pixels beside the part's surface, a step before it.
  double pierced = 0;  ///< The same without a step: the measured surface passes through the part's.
  float rms_error_m = 0;  ///< Of the confirmed pixels, along their normals.

  /// Share of the pixels not hidden that are confirmed, unweighted. [0, 1]
  double support() const
  {
    return visible_px > 0 ? static_cast<double>(confirmed.size()) / visible_px : 0.0;
  }

  /// Pixels along the edges in sight that tell something, at least 1.
  double edgesInSight() const
  {
    return std::max(1.0, outline_held + outline_broken + stepped + pierced);
  }

  /// Weight of the pixels that nothing in front hides.
  double expected() const
  {
    return confirmed_weight + looked_through + wrong_normal + missing + outside;
  }
};

/// Renders the part at the pose and compares pixel by pixel.
/// @param T_camera_model  Mesh frame to camera frame [m].
PoseEvidence gatherEvidence(const RangeImage& image, const PpfModel& model,
                            const Eigen::Isometry3f& T_camera_model, const DetectorConfig& config);

/// Share of the surface the camera should see that the cloud confirms, in [0, 1]. What it claims
/// beyond `confirmed` and its broken edges count against it.
/// @param confirmed  Weight of the confirmed pixels that count, at most confirmed_weight.
double poseScore(const PoseEvidence& evidence, double confirmed);

/// How much the cloud speaks for the pose, in pixels; below zero it speaks against it. Unlike the
/// score it grows with the surface explained, so that a pose claiming little does not win over one
/// explaining more.
double evidenceBalance(const PoseEvidence& evidence, double confirmed);

/// evidenceBalance() without what something in front hides and without what was not measured: of
/// two poses that explain the same pixels, the one of which less is seen is no worse for that.
double seenBalance(const PoseEvidence& evidence, double confirmed);

/// Share of what a free part would show that nothing in front hides, in [0, 1].
double visibleFraction(const PoseEvidence& evidence);
}  // namespace ppf_bin_picking

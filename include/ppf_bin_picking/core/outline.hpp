/// @file The outline of a rendered part and where the measured surface really ends.
#pragma once

#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/range_image.hpp"

#include <Eigen/Geometry>

#include <array>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// How far across the outline the measured surface is followed, to each side [px].
constexpr int kOutlineReach_px = 12;

/// A pixel of the part's outline.
struct OutlinePoint
{
  Eigen::Vector3f point;      ///< On the part, camera frame [m].
  Eigen::Vector2f direction;  ///< Out of the part, in the image, unit length.
  /// Depth that the part's surface has, or would have if it went on, at the pixels across the
  /// outline, relative to the depth of the point [m]; the middle entry is the point's own. 0 beyond
  /// the reach that was asked for.
  std::array<float, 2 * kOutlineReach_px + 1> profile_m;
};

/// True if the part is deeper at a second pixel than at a first one by more than a fall and what
/// the slopes of both surfaces explain.
bool isSteepFall(const RenderedPart& view, const PinholeCamera& camera, int column, int row,
                 int next_column, int next_row, float jump_m);

/// True if the surface at a pixel of a rendered part ends before another pixel nearby: the part is
/// not there, or deeper by more than a fall and what the surfaces' slopes explain.
inline bool surfaceEnds(const RenderedPart& view, const PinholeCamera& camera, int column, int row,
                        int next_column, int next_row, float jump_m)
{
  if (next_column < 0 || next_row < 0 || next_column >= view.width || next_row >= view.height)
    return true;
  const float next_m = view.depthAt(next_column, next_row);
  return next_m == 0 || (next_m - view.depthAt(column, row) >= jump_m &&
                         isSteepFall(view, camera, column, row, next_column, next_row, jump_m));
}

/// Pixels from a pixel of a rendered part to the part's outline, along rows and columns: 0 on it.
/// @param jump_m    Least fall within the part.
/// @param reach_px  The answer where the outline is as far or farther.
inline int outlineDistance(const RenderedPart& view, const PinholeCamera& camera, int column,
                           int row, float jump_m, int reach_px)
{
  for (int k = 1; k <= reach_px; ++k)
    for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (surfaceEnds(view, camera, column, row, column + k * du, row + k * dv, jump_m))
        return k - 1;
  return reach_px;
}

/// Points of the outline of a rendered part: pixels with the part's surface on one side and, on the
/// other, nothing or a part of it that lies deeper: rims of holes belong to the outline.
/// @param jump_m    Least fall within the part.
/// @param reach_px  So far to each side the profile is filled; at most kOutlineReach_px.
/// @param stride    Every so many of them.
std::vector<OutlinePoint> outlineOf(const RenderedPart& view, const PinholeCamera& camera,
                                    float jump_m, int reach_px, int stride);

/// What was measured across an outline point.
enum class OutlineEnd
{
  kBehind,   ///< The surface ends there: farther out the cloud lies behind.
  kMissing,  ///< Up to the outline or beyond, nothing was measured; the surface may end there.
  kGoesOn,   ///< The surface goes on beyond the outline, straight or rising.
  kAbsent,   ///< The part's surface is not there; the cloud lies behind it.
  kHidden,   ///< Something else lies in front, or too little was measured to tell.
};

/// Where the measured surface ends.
struct OutlineMatch
{
  OutlineEnd end = OutlineEnd::kHidden;
  /// Last pixel on the surface: above zero beyond the part's outline, below within it. Where pixels
  /// were lost before the cloud lies behind, the nearest to the outline of the ends they allow;
  /// where the surface is absent, as far within as was looked.
  int offset_px = 0;
};

/// Follows the measured surface across an outline point from the inside out.
/// @param point_camera  The outline point where the part is now, camera frame [m].
/// @param gate_m        Depth by which the surface may differ from the part's.
/// @param reach_px      At most that of the outline's profile.
OutlineMatch matchOutline(const RangeImage& image, const OutlinePoint& outline,
                          const Eigen::Vector3f& point_camera, float gate_m, int reach_px);
}  // namespace ppf_bin_picking

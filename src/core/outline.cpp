#include "ppf_bin_picking/core/outline.hpp"

#include "draw_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ppf_bin_picking
{
namespace
{
constexpr float kPlaneFacing = 0.3F;    // flatter surfaces are not extended beyond the outline
constexpr float kLeastFacing = 0.02F;   // flatter surfaces count as this flat
constexpr float kSlopeMargin = 1.5F;    // pixels of slope that are no step
constexpr int kDirectionRadius_px = 2;  // window that gives the outline's direction

/// The nearest integer; a library's call for it would be most of a profile's cost.
int rounded(float value)
{
  return static_cast<int>(value + (value < 0 ? -0.5F : 0.5F));
}

bool covered(const RenderedPart& view, int column, int row)
{
  return column >= 0 && row >= 0 && column < view.width && row < view.height &&
         view.depthAt(column, row) > 0;
}

/// True if a place lies in the image, and not on its rim.
bool isInside(const PinholeCamera& camera, const Eigen::Vector2f& at)
{
  return at.x() > 0 && at.y() > 0 && at.x() < static_cast<float>(camera.width - 1) &&
         at.y() < static_cast<float>(camera.height - 1);
}

/// The depth nearest to a place inside the image [m].
float depthNear(const RangeImage& image, const Eigen::Vector2f& at)
{
  return image.depth[image.index(static_cast<int>(at.x() + 0.5F), static_cast<int>(at.y() + 0.5F))];
}

/// How much deeper the surface at a pixel gets over one pixel, at most [m].
float slopeAt(const RenderedPart& view, const PinholeCamera& camera, int column, int row)
{
  const float z = view.depthAt(column, row);
  const Eigen::Vector3f ray =
      camera.ray(static_cast<float>(view.left + column), static_cast<float>(view.top + row));
  const Eigen::Vector3f& normal =
      view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
  const float cosine = std::max(kLeastFacing, std::abs(normal.dot(ray)) / ray.norm());
  return z / camera.fx * std::sqrt(1 - std::min(1.0F, cosine * cosine)) / cosine;
}

/// From the surface's pixels to the others around a pixel; zero if they balance.
Eigen::Vector2f outwardDirection(const RenderedPart& view, const PinholeCamera& camera, int column,
                                 int row, float jump_m)
{
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (int dr = -kDirectionRadius_px; dr <= kDirectionRadius_px; ++dr)
    for (int dc = -kDirectionRadius_px; dc <= kDirectionRadius_px; ++dc)
      if (surfaceEnds(view, camera, column, row, column + dc, row + dr, jump_m))
        sum += Eigen::Vector2f(static_cast<float>(dc), static_cast<float>(dr));
  const float length = sum.norm();
  return length > 1 ? Eigen::Vector2f(sum / length) : Eigen::Vector2f::Zero();
}

/// Relative depths along the direction: the part's where it is, its plane's beyond.
void fillProfile(const RenderedPart& view, const PinholeCamera& camera, int column, int row,
                 int reach_px, OutlinePoint& outline)
{
  constexpr int kCount = 2 * kOutlineReach_px + 1;
  std::array<int, kCount> columns, rows;  // relative to the point's
  for (int i = 0; i < kCount; ++i)
  {
    const auto step = static_cast<float>(i - kOutlineReach_px);
    columns[i] = rounded(step * outline.direction.x());
    rows[i] = rounded(step * outline.direction.y());
  }
  std::array<float, kCount>& profile_m = outline.profile_m;
  const Eigen::Vector3f& normal =
      view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
  const float z0 = view.depthAt(column, row);
  const float facing = std::abs(normal.dot(outline.point)) / outline.point.norm();
  // The plane's depth at a pixel is plane / (normal . ray), which grows by constants.
  const float plane = normal.dot(outline.point), here = plane / z0;
  const float by_column = normal.x() / camera.fx, by_row = normal.y() / camera.fy;
  const bool goes_on = facing > kPlaneFacing;
  for (int i = 0; i < kCount; ++i)
    profile_m[i] = goes_on ? plane / (here + static_cast<float>(columns[i]) * by_column +
                                      static_cast<float>(rows[i]) * by_row) -
                                 z0
                           : 0.0F;
  for (int i = kOutlineReach_px - reach_px; i <= kOutlineReach_px; ++i)
    if (covered(view, column + columns[i], row + rows[i]))
      profile_m[i] = view.depthAt(column + columns[i], row + rows[i]) - z0;
  std::fill(profile_m.begin(), profile_m.end() - (kOutlineReach_px + 1 + reach_px), 0.0F);
  std::fill(profile_m.begin() + (kOutlineReach_px + 1 + reach_px), profile_m.end(), 0.0F);
}

/// The pixels beside which the part may end, see markFalls(), row after row.
std::vector<std::uint32_t> pixelsBesideFalls(const RenderedPart& view, float jump_m)
{
  constexpr std::size_t kTogether = sizeof(std::uint64_t);
  const std::size_t count = view.depth.size();
  std::vector<std::uint8_t> marks(count + kTogether, 0);
  markFalls(view.depth.data(), view.width, view.height, jump_m, marks.data());
  std::vector<std::uint32_t> pixels;
  for (std::size_t first = 0; first < count; first += kTogether)
  {
    std::uint64_t some;
    std::memcpy(&some, &marks[first], sizeof(some));
    for (std::size_t i = first; some != 0 && i < first + kTogether; ++i)
      if (marks[i] != 0) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return pixels;
}

/// The end of a surface that the cloud lies behind from a pixel on. What is lost or mixed in
/// between may be the part's, up to an edge in the pixel behind: of the ends that this allows, the
/// nearest to the part's outline.
int endBetween(int last_px, int behind_px)
{
  return behind_px == last_px + 1 ? last_px : std::clamp(0, last_px, behind_px);
}
}  // namespace

bool isSteepFall(const RenderedPart& view, const PinholeCamera& camera, int column, int row,
                 int next_column, int next_row, float jump_m)
{
  const float fall_m = view.depthAt(next_column, next_row) - view.depthAt(column, row);
  const auto distance_px =
      static_cast<float>(std::max(std::abs(next_column - column), std::abs(next_row - row)));
  const float slope_m =
      std::max(slopeAt(view, camera, column, row), slopeAt(view, camera, next_column, next_row));
  return fall_m > jump_m + kSlopeMargin * distance_px * slope_m;
}

std::vector<OutlinePoint> outlineOf(const RenderedPart& view, const PinholeCamera& camera,
                                    float jump_m, int reach_px, int stride)
{
  std::vector<OutlinePoint> outline;
  int seen = 0;
  for (const std::uint32_t pixel : pixelsBesideFalls(view, jump_m))
  {
    const int column = static_cast<int>(pixel) % view.width;
    const int row = static_cast<int>(pixel) / view.width;
    const auto ends = [&](int dc, int dr)
    { return surfaceEnds(view, camera, column, row, column + dc, row + dr, jump_m); };
    const bool inner = !ends(-1, 0) && !ends(1, 0) && !ends(0, -1) && !ends(0, 1);
    if (inner || seen++ % stride != 0) continue;
    OutlinePoint point;
    point.direction = outwardDirection(view, camera, column, row, jump_m);
    if (point.direction.isZero()) continue;
    const Eigen::Vector3f ray =
        camera.ray(static_cast<float>(view.left + column), static_cast<float>(view.top + row));
    point.point = ray * view.depth[pixel];
    fillProfile(view, camera, column, row, reach_px, point);
    outline.push_back(point);
  }
  return outline;
}

OutlineMatch matchOutline(const RangeImage& image, const OutlinePoint& outline,
                          const Eigen::Vector3f& point_camera, float gate_m, int reach_px)
{
  if (!(point_camera.z() > 0)) return {};
  const Eigen::Vector2f pixel = image.camera.project(point_camera);
  const Eigen::Vector2f whole_reach = static_cast<float>(reach_px) * outline.direction;
  const bool is_inside =
      isInside(image.camera, pixel - whole_reach) && isInside(image.camera, pixel + whole_reach);
  bool on_surface = false, hidden = false;
  int absent = 0, last_px = 0;
  float last_z = 0;
  for (int t = -reach_px; t <= reach_px; ++t)
  {
    const Eigen::Vector2f at = pixel + static_cast<float>(t) * outline.direction;
    if (!is_inside && !isInside(image.camera, at)) return {};
    const float z = depthNear(image, at);
    const float expected_m =
        point_camera.z() + outline.profile_m[static_cast<std::size_t>(t + kOutlineReach_px)];
    const float behind_m = z - expected_m;
    if (z > 0 && std::abs(behind_m) <= gate_m && (on_surface || t <= 0))
    {
      on_surface = true;
      last_px = t;
      last_z = z;
      continue;
    }
    if (!on_surface)
    {
      hidden = hidden || (z > 0 && behind_m < 0);
      absent += z > 0 && behind_m > 0 ? 1 : 0;
      continue;
    }
    if (z == 0 && t >= 0) return {OutlineEnd::kMissing, last_px};
    if (z == 0) continue;  // a lost flank, unless the cloud lies behind before the outline
    if (behind_m > 0) return {OutlineEnd::kBehind, endBetween(last_px, t)};
    const bool rises = z > last_z - gate_m;  // else something is in front
    last_z = z;
    if (rises && t == last_px + 1 && t < reach_px) continue;  // one pixel may mix two surfaces
    return {rises ? OutlineEnd::kGoesOn : OutlineEnd::kHidden, last_px};
  }
  if (on_surface) return {OutlineEnd::kGoesOn, last_px};
  if (hidden || absent <= reach_px) return {};
  return {OutlineEnd::kAbsent, -reach_px};
}
}  // namespace ppf_bin_picking

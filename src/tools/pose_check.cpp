#include "pose_check.hpp"

#include "ppf_bin_picking/core/boundary_table.hpp"
#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/outline.hpp"
#include "ppf_bin_picking/core/pca.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kGateRel = 0.03F;            // of the diameter
constexpr float kSurfaceSpacingRel = 0.01F;  // of the diameter
constexpr float kInsideRel = 0.02F;  // depth under the other's surface that counts as inside
constexpr std::size_t kOverlapSamples = 800;
constexpr float kMinFacing = 0.3F;  // surfaces flatter to the line of sight are left out
constexpr float kRingRel =
    0.05F;  // of the diameter: sensors lose and smear surfaces so near to their outline
constexpr double kSameOrientation_rad = 0.35;  // refitting goes that far
constexpr double kMaxLookedThrough = 0.15;
constexpr double kMaxOverlap = 0.05;
constexpr double kMaxRmseRel = 0.5;  // of the gate

Eigen::Isometry3f halfTurn(const Eigen::Vector3f& axis, const Eigen::Vector3f& center)
{
  Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
  motion.linear() =
      Eigen::AngleAxisf(static_cast<float>(M_PI), axis.normalized()).toRotationMatrix();
  motion.translation() = center - motion.linear() * center;
  return motion;
}
/// True if a ray from a point meets a triangle (Moeller and Trumbore 1997).
bool meets(const std::array<Eigen::Vector3f, 3>& corners, const Eigen::Vector3f& origin,
           const Eigen::Vector3f& direction)
{
  const Eigen::Vector3f a = corners[1] - corners[0];
  const Eigen::Vector3f b = corners[2] - corners[0];
  const Eigen::Vector3f p = direction.cross(b);
  const float determinant = a.dot(p);
  if (determinant == 0) return false;
  const Eigen::Vector3f t = origin - corners[0];
  const float u = t.dot(p) / determinant;
  const Eigen::Vector3f q = t.cross(a);
  const float v = direction.dot(q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && b.dot(q) / determinant > 0;
}

/// True if most of three rays leave the mesh an odd number of times; a small hole does not matter.
bool isInside(const TriangleMesh& mesh, const Eigen::Vector3f& point)
{
  const std::array<Eigen::Vector3f, 3> directions = {
      Eigen::Vector3f(0.31F, 0.52F, 0.79F), {-0.63F, 0.71F, -0.29F}, {0.17F, -0.83F, -0.53F}};
  std::array<bool, 3> odd = {false, false, false};
  for (const auto& [a, b, c] : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (meets({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, point, directions[k]))
        odd[k] = !odd[k];
  return std::count(odd.begin(), odd.end(), true) >= 2;
}
}  // namespace

std::vector<NearSymmetry> nearSymmetries(const PpfModel& model)
{
  const Eigen::Vector3f& center = model.data().center;
  std::vector<NearSymmetry> all;
  if (model.symmetries().revolution())
  {
    const Eigen::Vector3f axis = model.symmetries().revolution()->axis.cast<float>();
    all.push_back({"end for end", halfTurn(axis.unitOrthogonal(), center)});
  }
  else
  {
    const Eigen::Matrix3f axes =
        principalBox(model.data().points).T_cloud_box.linear().cast<float>();
    const char* const names[3] = {"about long axis", "about middle axis", "about short axis"};
    for (int k = 0; k < 3; ++k)
      all.push_back({names[k], halfTurn(axes.col(k), center)});
  }
  const auto is_true = [&](const NearSymmetry& turn)
  {
    const Eigen::Quaternionf rotation(turn.T_model_model.linear());
    return model.symmetries().rotationDistance(Eigen::Quaternionf::Identity(), rotation) <
           kSameOrientation_rad;
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_true), all.end());
  return all;
}

/// A pose against the image.
struct PoseChecker::Fit
{
  Eigen::Isometry3f T_camera_model;
  double sum_squared = 0;          ///< Of visible surface points to the cloud [m^2].
  std::size_t count = 0;           ///< Of these.
  double found_squared = 0;        ///< Of those of them that the cloud does not lie behind [m^2].
  std::size_t found = 0;           ///< Of these.
  std::size_t inner = 0;           ///< Of the visible points, those away from the outline.
  std::size_t looked_through = 0;  ///< Of the inner ones.
  std::vector<std::uint32_t> claimed;  ///< Pixels it covers whose point is near its surface.
};

PoseChecker::PoseChecker(const RangeImage& image, const PpfModel& model,
                         const DetectorConfig& config)
    : image_(image),
      model_(model),
      config_(config),
      gate_m_(kGateRel * static_cast<float>(model.diameter())),
      near_symmetries_(nearSymmetries(model))
{
  TriangleMesh mesh = model.data().mesh;
  surface_ = sampleVisibleSurface(mesh, kSurfaceSpacingRel * static_cast<float>(model.diameter()));
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
      if (image.depth[image.index(u, v)] > 0) scene_.push_back(image.point(u, v));
  surface_search_ = std::make_unique<NeighborSearch>(surface_.points);
  scene_search_ = std::make_unique<NeighborSearch>(scene_);
}

PoseChecker::~PoseChecker() = default;

double PoseChecker::distanceToModel(const Eigen::Vector3f& point_model) const
{
  std::vector<std::pair<std::uint32_t, float>> nearest;
  surface_search_->nearest(point_model, 1, nearest);
  return std::sqrt(static_cast<double>(nearest.front().second));
}

PoseChecker::Fit PoseChecker::fitOf(const Eigen::Isometry3f& pose) const
{
  Fit fit;
  fit.T_camera_model = pose;
  const Eigen::Isometry3f T_model_camera = pose.inverse(Eigen::Isometry);
  const auto diameter = static_cast<float>(model_.diameter());
  const float depth_m = (pose * model_.data().center).z();
  const int ring_px =
      std::max(1, static_cast<int>(kRingRel * diameter * image_.camera.fx / depth_m));
  const float jump_m = boundaryJump(diameter);
  RenderedPart view;
  renderPart(model_.renderable(), pose, image_.camera, view);
  std::vector<std::pair<std::uint32_t, float>> nearest;
  for (int row = 0; row < view.height; ++row)
  {
    for (int column = 0; column < view.width; ++column)
    {
      const float z = view.depthAt(column, row);
      const int u = view.left + column;
      const int v = view.top + row;
      const float measured = image_.depth[image_.index(u, v)];
      if (z == 0 || measured == 0) continue;
      if (distanceToModel(T_model_camera * image_.point(u, v)) < gate_m_)
        fit.claimed.push_back(static_cast<std::uint32_t>(image_.index(u, v)));
      if (measured < z - gate_m_) continue;  // hidden
      const Eigen::Vector3f ray = image_.camera.ray(static_cast<float>(u), static_cast<float>(v));
      const auto pixel = static_cast<std::size_t>(row) * view.width + column;
      const Eigen::Vector3f& normal = view.normals[view.triangle[pixel]];
      if (std::abs(normal.dot(ray)) < kMinFacing * ray.norm()) continue;
      scene_search_->nearest(z * ray, 1, nearest);
      const bool behind = measured > z + gate_m_;
      const float squared = std::min(nearest.front().second, gate_m_ * gate_m_);
      fit.sum_squared += squared;
      ++fit.count;
      fit.found_squared += behind ? 0 : squared;
      fit.found += behind ? 0 : 1;
      if (outlineDistance(view, image_.camera, column, row, jump_m, ring_px) < ring_px) continue;
      ++fit.inner;
      fit.looked_through += behind ? 1 : 0;
    }
  }
  return fit;
}

double PoseChecker::bothWays(const Fit& fit, const std::vector<std::uint32_t>& claimed) const
{
  const Eigen::Isometry3f T_model_camera = fit.T_camera_model.inverse(Eigen::Isometry);
  double sum_squared = fit.sum_squared;
  const auto columns = static_cast<std::uint32_t>(image_.camera.width);
  for (const std::uint32_t pixel : claimed)
  {
    const Eigen::Vector3f point =
        image_.point(static_cast<int>(pixel % columns), static_cast<int>(pixel / columns));
    const double distance =
        std::min(distanceToModel(T_model_camera * point), static_cast<double>(gate_m_));
    sum_squared += distance * distance;
  }
  const std::size_t count = fit.count + claimed.size();
  return count == 0 ? gate_m_ : std::sqrt(sum_squared / static_cast<double>(count));
}

double PoseChecker::overlapOf(const Eigen::Isometry3f& pose, const Eigen::Isometry3f& other) const
{
  const auto diameter = static_cast<float>(model_.diameter());
  const Eigen::Vector3f& center = model_.data().center;
  if ((pose * center - other * center).norm() > diameter) return 0;
  const Eigen::Isometry3f T_other_pose = other.inverse(Eigen::Isometry) * pose;
  const std::size_t stride = std::max(std::size_t{1}, surface_.size() / kOverlapSamples);
  std::size_t inside = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < surface_.size(); i += stride, ++count)
  {
    const Eigen::Vector3f point = T_other_pose * surface_.points[i];
    const bool far = (point - center).norm() > diameter / 2;
    if (far || distanceToModel(point) < kInsideRel * diameter) continue;
    if (isInside(model_.data().mesh, point)) ++inside;
  }
  return static_cast<double>(inside) / static_cast<double>(count);
}

void PoseChecker::addVerdict(PoseCheck& check) const
{
  const auto doubt = [&](const std::string& text)
  { check.verdict += (check.verdict.empty() ? "" : ", ") + text; };
  if (check.rmse_m > kMaxRmseRel * gate_m_) doubt("fits badly");
  if (check.turned_m >= 0 && check.turned_m < check.both_ways_m)
    doubt("fits better turned " + check.turn);
  if (check.looked_through > kMaxLookedThrough) doubt("looked through");
  if (check.overlap > kMaxOverlap) doubt("inside another part");
  if (check.verdict.empty()) check.verdict = "ok";
}

std::vector<PoseCheck> PoseChecker::check(const std::vector<Eigen::Isometry3f>& poses) const
{
  std::vector<PoseCheck> checks;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    PoseCheck check;
    std::vector<Fit> fits = {fitOf(poses[i])};
    for (const NearSymmetry& turn : near_symmetries_)
      fits.push_back(fitOf(refinePose(image_, model_, poses[i] * turn.T_model_model, config_)));
    // What any of them claims is to be explained by each, or the one that claims least would win.
    std::vector<std::uint32_t> claimed;
    for (const Fit& fit : fits)
      claimed.insert(claimed.end(), fit.claimed.begin(), fit.claimed.end());
    std::sort(claimed.begin(), claimed.end());
    claimed.erase(std::unique(claimed.begin(), claimed.end()), claimed.end());

    check.rmse_m = fits[0].found == 0
                       ? gate_m_
                       : std::sqrt(fits[0].found_squared / static_cast<double>(fits[0].found));
    check.both_ways_m = bothWays(fits[0], claimed);
    for (std::size_t k = 1; k < fits.size(); ++k)
    {
      const double turned = bothWays(fits[k], claimed);
      if (check.turned_m >= 0 && turned >= check.turned_m) continue;
      check.turned_m = turned;
      check.turn = near_symmetries_[k - 1].name;
    }
    check.looked_through = fits[0].inner == 0 ? 1.0
                                              : static_cast<double>(fits[0].looked_through) /
                                                    static_cast<double>(fits[0].inner);
    for (std::size_t k = 0; k < poses.size(); ++k)
    {
      const double overlap = k == i ? 0.0 : overlapOf(poses[i], poses[k]);
      if (overlap <= check.overlap) continue;
      check.overlap = overlap;
      check.overlap_with = static_cast<int>(k);
    }
    addVerdict(check);
    checks.push_back(check);
  }
  return checks;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/look_alikes.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/pca.hpp"
#include "ppf_bin_picking/core/ppf_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr float kPlaneRel = 0.03F;      // distance from a surface that is in place, of the diameter
constexpr float kSpacings = 1.5F;       // to the next sample, in sampling distances
constexpr float kLikeCosine = 0.9F;     // of two normals
constexpr double kLeastShare = 0.5;     // of the samples
constexpr float kSameTurn_rad = 0.26F;  // turns nearer than this are the same
constexpr std::size_t kSamples = 400;   // that are looked at, about
constexpr std::size_t kMost = 3;

/// The share of the samples that a turn takes onto the surface.
double shareInPlace(const PpfModelData& model, const NeighborSearch& search,
                    const Eigen::Isometry3f& turn)
{
  const float spacing_m =
      kSpacings * static_cast<float>(model.parameters.step_rel) * model.diameter_m;
  std::vector<std::pair<std::uint32_t, float>> nearest;
  const std::size_t stride = std::max<std::size_t>(1, model.points.size() / kSamples);
  std::size_t count = 0, tried = 0;
  for (std::size_t i = 0; i < model.points.size(); i += stride)
  {
    ++tried;
    const Eigen::Vector3f point = turn * model.points[i];
    search.nearest(point, 1, nearest);
    const auto& [index, squared_m2] = nearest.front();
    const Eigen::Vector3f& normal = model.normals[index];
    count += squared_m2 < spacing_m * spacing_m &&
             std::abs(normal.dot(point - model.points[index])) < kPlaneRel * model.diameter_m &&
             normal.dot(turn.linear() * model.normals[i]) > kLikeCosine;
  }
  return static_cast<double>(count) / static_cast<double>(tried);
}

/// Turns about the axes of the samples' box, relative to the model's centre.
std::vector<Eigen::Isometry3f> turnsOfBox(const PpfModelData& model)
{
  const Eigen::Isometry3f T_samples_box = principalBox(model.points).T_cloud_box.cast<float>();
  std::vector<Eigen::Isometry3f> turns;
  for (int axis = 0; axis < 3; ++axis)
    for (const int degrees :
         {30, 45, 60, 90, 120, 135, 150, 180, 210, 225, 240, 270, 300, 315, 330})
    {
      const float angle_rad = static_cast<float>(degrees) * static_cast<float>(M_PI) / 180;
      const Eigen::AngleAxisf turn(angle_rad, Eigen::Vector3f::Unit(axis));
      turns.push_back(T_samples_box * turn * T_samples_box.inverse());
    }
  return turns;
}
}  // namespace

std::vector<Eigen::Isometry3f> lookAlikeTurns(const PpfModelData& model,
                                              const SymmetryGroup& symmetries)
{
  const NeighborSearch search(model.points);
  std::vector<std::pair<double, Eigen::Isometry3f>> found;
  for (const Eigen::Isometry3f& turn : turnsOfBox(model))
  {
    const double share = shareInPlace(model, search, turn);
    if (share >= kLeastShare) found.emplace_back(share, turn);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::Isometry3f> turns;
  std::vector<Eigen::Quaternionf> known = {Eigen::Quaternionf::Identity()};
  for (const auto& [share, turn] : found)
  {
    const Eigen::Quaternionf rotation(turn.linear());
    const auto same = [&](const Eigen::Quaternionf& other)
    { return symmetries.rotationDistance(other, rotation) < kSameTurn_rad; };
    if (turns.size() == kMost || std::any_of(known.begin(), known.end(), same)) continue;
    known.push_back(rotation);
    const Eigen::Translation3f center(model.center);
    turns.push_back(center * turn * center.inverse());
  }
  return turns;
}
}  // namespace ppf_bin_picking

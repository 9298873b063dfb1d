#include "ppf_bin_picking/core/ambiguity.hpp"

#include <algorithm>
#include <cstdint>

namespace ppf_bin_picking
{
namespace
{
constexpr double kRivalShare = 0.5;  // of a pose's pixels that a rival claims at least

/// The standing pose that owns each pixel; -1: none.
using Owners = std::vector<std::int32_t>;

Owners ownersOf(const std::vector<Candidate>& candidates, const std::vector<SelectedPose>& selected,
                std::size_t pixels)
{
  Owners owners(pixels, -1);
  for (std::size_t i = 0; i < selected.size(); ++i)
    for (const PoseEvidence::Pixel& pixel : candidates[selected[i].candidate].evidence.confirmed)
      if (owners[pixel.index] < 0) owners[pixel.index] = static_cast<std::int32_t>(i);
  return owners;
}

/// Looks at what lies beyond a pose's outline: the share of it against the worst slide that does
/// not hold, and the pixels where the surface goes on.
void assessOutline(const PoseEvidence& evidence, std::int32_t self, const Owners& owners,
                   const std::vector<bool>& held_poses, Ambiguity& ambiguity)
{
  SlideStops held = evidence.slide_held, broken = evidence.slide_broken;
  ambiguity.goes_on_px = 0;
  for (const PoseEvidence::Continuation& continuation : evidence.goes_on)
  {
    const std::int32_t owner = owners[continuation.pixel];
    const bool stops = owner >= 0 && owner != self && held_poses[static_cast<std::size_t>(owner)];
    addSlideStop(continuation.direction, stops ? held : broken);
    if (!stops) ++ambiguity.goes_on_px;
  }
  ambiguity.slide_share = 0;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] + broken[k] > 0)
      ambiguity.slide_share = std::max(ambiguity.slide_share, broken[k] / (held[k] + broken[k]));
}

void assessSlides(const DetectorConfig& config, const std::vector<Candidate>& candidates,
                  const std::vector<SelectedPose>& selected, const Owners& owners,
                  std::vector<Ambiguity>& ambiguities)
{
  std::vector<bool> held(selected.size(), false);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      if (held[i]) continue;
      assessOutline(candidates[selected[i].candidate].evidence, static_cast<std::int32_t>(i),
                    owners, held, ambiguities[i]);
      held[i] = ambiguities[i].slide_share <= config.max_slide_share;
      changed = changed || held[i];
    }
  }
  // Once more, now that it is known which neighbours are held.
  for (std::size_t i = 0; i < selected.size(); ++i)
    assessOutline(candidates[selected[i].candidate].evidence, static_cast<std::int32_t>(i), owners,
                  held, ambiguities[i]);
}

void assessRivals(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                  const std::vector<Candidate>& candidates,
                  const std::vector<SelectedPose>& selected, const Owners& owners,
                  std::vector<Ambiguity>& ambiguities)
{
  std::vector<double> owned(selected.size());
  for (std::size_t c = 0; c < candidates.size(); ++c)
  {
    const PoseEvidence& rival = candidates[c].evidence;
    std::fill(owned.begin(), owned.end(), 0.0);
    double free = 0;
    for (const PoseEvidence::Pixel& pixel : rival.confirmed)
      (owners[pixel.index] < 0 ? free : owned[static_cast<std::size_t>(owners[pixel.index])]) +=
          pixel.weight;
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      const Candidate& pose = candidates[selected[i].candidate];
      const double confirmed = std::max(1.0, selected[i].confirmed);
      if (owned[i] < kRivalShare * confirmed || c == selected[i].candidate ||
          areNear(pose, candidates[c], *models[pose.model], config.group_distance_rel,
                  config.group_angle_rad))
        continue;
      const double lead = seenBalance(pose.evidence, selected[i].confirmed) - pose.climbed -
                          seenBalance(rival, free + owned[i]);
      ambiguities[i].margin = std::min(ambiguities[i].margin, lead / confirmed);
    }
  }
}

Eigen::Vector3f centerOf(const Candidate& candidate, const std::vector<const PpfModel*>& models)
{
  return candidate.T_camera_model * models[candidate.model]->data().center;
}

/// Looks for candidates that the time limit left unverified.
void findUnknownRivals(const std::vector<const PpfModel*>& models,
                       const std::vector<Candidate>& candidates,
                       const std::vector<SelectedPose>& selected,
                       std::vector<Ambiguity>& ambiguities)
{
  for (const Candidate& rival : candidates)
  {
    if (rival.verified) continue;
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      const Candidate& pose = candidates[selected[i].candidate];
      const auto reach_m = static_cast<float>(
          std::max(models[pose.model]->diameter(), models[rival.model]->diameter()));
      if ((centerOf(pose, models) - centerOf(rival, models)).norm() < reach_m)
        ambiguities[i].rivals_known = false;
    }
  }
}
}  // namespace

std::vector<Ambiguity> assessAmbiguity(const std::vector<const PpfModel*>& models,
                                       const DetectorConfig& config,
                                       const std::vector<Candidate>& candidates,
                                       const std::vector<SelectedPose>& selected,
                                       std::size_t pixels)
{
  std::vector<Ambiguity> ambiguities(selected.size());
  const Owners owners = ownersOf(candidates, selected, pixels);
  assessSlides(config, candidates, selected, owners, ambiguities);
  assessRivals(models, config, candidates, selected, owners, ambiguities);
  findUnknownRivals(models, candidates, selected, ambiguities);
  return ambiguities;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/boundary_matcher.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"

#include "vote_peaks.hpp"

namespace ppf_bin_picking
{
namespace
{
/// The pose that lays the model's boundary point and frame onto the scene's.
PoseHypothesis poseOfMatch(const BoundaryPoint& scene, const BoundaryPoint& model,
                           std::uint32_t votes)
{
  PoseHypothesis hypothesis;
  hypothesis.rotation = Eigen::Quaternionf(scene.frame() * model.frame().transpose()).normalized();
  hypothesis.center = scene.point - hypothesis.rotation * model.point;
  hypothesis.votes = static_cast<float>(votes);
  return hypothesis;
}

/// Counts the points that entries name.
void count(const std::uint32_t* first, const std::uint32_t* last, std::uint32_t* votes)
{
  for (; first != last; ++first)
    ++votes[*first];
}
}  // namespace

std::vector<PoseHypothesis> matchBoundary(const std::vector<BoundaryPoint>& scene,
                                          const PpfModel& model, const DetectorConfig& config,
                                          const Deadline& deadline)
{
  const BoundaryTable& table = model.data().boundary;
  if (scene.empty() || table.points.empty()) return {};
  const BoundaryQuantizer quantizer(model.data().diameter_m);
  std::vector<Eigen::Vector3f> places;
  for (const BoundaryPoint& boundary : scene)
    places.push_back(boundary.point);
  const NeighborSearch search(places);
  std::vector<std::vector<PoseHypothesis>> peaks(scene.size());
  const auto match = [&](std::size_t i)
  {
    if (deadline.passed()) return;
    thread_local std::vector<std::uint32_t> votes_of_thread, near_of_thread;
    std::vector<std::uint32_t>&votes = votes_of_thread, &near = near_of_thread;
    votes.assign(table.points.size(), 0);
    search.withinInAnyOrder(places[i], model.data().diameter_m, near);
    const Eigen::Matrix3f frame = scene[i].frame();
    for (const std::uint32_t j : near)
      if (const auto key = quantizer.key(scene[i], frame, scene[j]))
        count(table.entries.data() + table.offsets[*key],
              table.entries.data() + table.offsets[*key + 1], votes.data());
    peaks[i] = distinctPeaks(strongestCells(votes, config.peak_ratio), model, config,
                             [&](std::uint32_t cell)
                             { return poseOfMatch(scene[i], table.points[cell], votes[cell]); });
  };
  parallelFor(config.threads, scene.size(), match);

  std::vector<PoseHypothesis> hypotheses;
  for (const auto& found : peaks)
    hypotheses.insert(hypotheses.end(), found.begin(), found.end());
  return hypotheses;
}
}  // namespace ppf_bin_picking

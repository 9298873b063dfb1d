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
    thread_local std::vector<std::uint32_t> votes, near;
    votes.assign(table.points.size(), 0);
    search.within(places[i], model.data().diameter_m, near);
    const Eigen::Matrix3f frame = scene[i].frame();
    for (const std::uint32_t j : near)
      if (const auto key = quantizer.key(scene[i], frame, scene[j]))
        for (std::uint32_t k = table.offsets[*key]; k < table.offsets[*key + 1]; ++k)
          ++votes[table.entries[k]];
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

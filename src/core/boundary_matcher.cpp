#include "ppf_bin_picking/core/boundary_matcher.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"

#include "vote_kernel.hpp"
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

/// The boundary points around one of them as arrays, and the votes of the pairs with it.
struct Neighborhood
{
  std::vector<std::uint32_t> near;
  BoundaryArrays boundary;
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> votes;
};
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
    thread_local Neighborhood around_of_thread;
    Neighborhood& around = around_of_thread;
    search.withinInAnyOrder(places[i], model.data().diameter_m, around.near);
    around.boundary.resize(around.near.size());
    for (std::size_t k = 0; k < around.near.size(); ++k)
    {
      const BoundaryPoint& second = scene[around.near[k]];
      around.boundary.set(k, second.point.data(), second.normal.data(), second.outward.data());
    }
    around.keys.resize(around.near.size());
    boundaryKeys(around.boundary, boundaryReference(scene[i]), quantizer.steps(),
                 around.keys.data());
    around.votes.assign(table.points.size(), 0);
    addBoundaryVotes({table.offsets.data(), table.entries.data()}, around.keys.size(),
                     around.keys.data(), around.votes.data());
    peaks[i] = distinctPeaks(strongestCells(around.votes, config.peak_ratio), model, config,
                             [&](std::uint32_t cell) {
                               return poseOfMatch(scene[i], table.points[cell], around.votes[cell]);
                             });
  };
  parallelFor(config.threads, scene.size(), match);

  std::vector<PoseHypothesis> hypotheses;
  for (const auto& found : peaks)
    hypotheses.insert(hypotheses.end(), found.begin(), found.end());
  return hypotheses;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/ppf_matcher.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/ppf.hpp"

#include "vote_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// Votes over (model reference point, alpha bin) for one scene reference point.
class Accumulator
{
public:
  void reset(std::size_t references, std::uint32_t alpha_bins)
  {
    alpha_bins_ = alpha_bins;
    cells_.assign(references * alpha_bins, 0);
  }

  /// Votes for entries [first, last) of the model's table. Works on copies of the members: a vote
  /// might change them for all that the compiler knows.
  void vote(const std::uint32_t* first, const std::uint32_t* last, std::uint16_t alpha_scene,
            std::uint32_t weight)
  {
    std::uint32_t* const cells = cells_.data();
    const std::uint32_t bins = alpha_bins_;
    for (; first != last; ++first)
    {
      const auto alpha = static_cast<std::uint16_t>(*first - alpha_scene);
      cells[(*first >> 16) * bins + (alpha * bins >> 16)] += weight;
    }
  }

  const std::vector<std::uint32_t>& cells() const { return cells_; }
  std::uint32_t votes(std::uint32_t cell) const { return cells_[cell]; }
  std::uint32_t reference(std::uint32_t cell) const { return cell / alpha_bins_; }

  /// The alpha [rad] of a cell: the centre of mass of the cell and its two neighbours round the
  /// circle.
  float alpha(std::uint32_t cell) const
  {
    const std::uint32_t first = cell / alpha_bins_ * alpha_bins_;
    const std::uint32_t bin = cell - first;
    const auto before = static_cast<float>(cells_[first + (bin + alpha_bins_ - 1) % alpha_bins_]);
    const auto here = static_cast<float>(cells_[cell]);
    const auto after = static_cast<float>(cells_[first + (bin + 1) % alpha_bins_]);
    const float offset = (after - before) / (before + here + after);
    const float step_rad = 2 * static_cast<float>(M_PI) / static_cast<float>(alpha_bins_);
    return (static_cast<float>(bin) + 0.5F + offset) * step_rad;
  }

private:
  std::uint32_t alpha_bins_ = 1;
  std::vector<std::uint32_t> cells_;
};

/// What the reference points share.
struct Matching
{
  const OrientedPoints& scene;
  const PpfModelData& model;
  const DetectorConfig& config;
  FeatureQuantizer quantizer;
  NeighborSearch search;
};

void castVotes(const Matching& matching, std::uint32_t reference, Accumulator& accumulator)
{
  thread_local std::vector<std::uint32_t> near_of_thread;
  std::vector<std::uint32_t>& near = near_of_thread;
  const Eigen::Vector3f& p1 = matching.scene.points[reference];
  const Eigen::Vector3f& n1 = matching.scene.normals[reference];
  const Eigen::Matrix3f rotation = rotationToX(n1);
  matching.search.withinInAnyOrder(p1, matching.model.diameter_m, near);
  for (const std::uint32_t j : near)
  {
    if (j == reference) continue;
    const Eigen::Vector3f& p2 = matching.scene.points[j];
    const Eigen::Vector3f& n2 = matching.scene.normals[j];
    const PairFeature feature = pairFeature(p1, n1, p2, n2);
    if (!matching.quantizer.covers(feature.distance_m)) continue;
    const std::uint32_t key = matching.quantizer.key(feature);
    const std::uint32_t begin = matching.model.offsets[key];
    const std::uint32_t end = matching.model.offsets[key + 1];
    if (begin == end) continue;
    const std::uint16_t alpha = pairAlpha(rotation, p1, p2);
    const std::uint32_t weight = voteWeight(n1, n2, matching.config.lambda, matching.config.v_min);
    const std::uint32_t* const entries = matching.model.entries.data();
    accumulator.vote(entries + begin, entries + end, alpha, weight);
  }
}

/// The pose that lays the model's reference point and normal onto the scene's, turned by alpha.
PoseHypothesis poseOfCell(const Matching& matching, std::uint32_t reference,
                          const Accumulator& accumulator, std::uint32_t cell)
{
  const std::uint32_t model_reference = accumulator.reference(cell);
  const Eigen::Matrix3f R_local_model = rotationToX(matching.model.normals[model_reference]);
  const Eigen::Matrix3f R_local_cloud = rotationToX(matching.scene.normals[reference]);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(accumulator.alpha(cell), Eigen::Vector3f::UnitX()).toRotationMatrix();
  PoseHypothesis hypothesis;
  hypothesis.rotation =
      Eigen::Quaternionf(R_local_cloud.transpose() * turn * R_local_model).normalized();
  hypothesis.center = matching.scene.points[reference] -
                      hypothesis.rotation * matching.model.points[model_reference];
  hypothesis.votes = static_cast<float>(accumulator.votes(cell)) / kVoteUnit;
  return hypothesis;
}

}  // namespace

std::uint32_t voteWeight(const Eigen::Vector3f& n1, const Eigen::Vector3f& n2, double lambda,
                         double v_min)
{
  const double weight = std::max(v_min, 1 - lambda * std::abs(static_cast<double>(n1.dot(n2))));
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(weight * kVoteUnit)));
}

std::vector<PoseHypothesis> matchModel(const OrientedPoints& scene, const PpfModel& model,
                                       const DetectorConfig& config, const Deadline& deadline)
{
  const PpfModelData& data = model.data();
  const Matching matching{scene, data, config, FeatureQuantizer(data.parameters, data.diameter_m),
                          NeighborSearch(scene.points)};
  const auto references = static_cast<std::size_t>(
      std::ceil(config.reference_share * static_cast<double>(scene.size())));
  std::vector<std::vector<PoseHypothesis>> peaks(references);
  const auto match = [&](std::size_t i)
  {
    if (deadline.passed()) return;
    thread_local Accumulator accumulator;
    const auto reference = static_cast<std::uint32_t>(i * scene.size() / references);
    accumulator.reset(std::max<std::size_t>(1, model.references()),
                      static_cast<std::uint32_t>(config.model.n_angle));
    castVotes(matching, reference, accumulator);
    peaks[i] = distinctPeaks(strongestCells(accumulator.cells(), config.peak_ratio), model, config,
                             [&](std::uint32_t cell)
                             { return poseOfCell(matching, reference, accumulator, cell); });
  };
  parallelFor(config.threads, references, match);

  std::vector<PoseHypothesis> hypotheses;
  for (const auto& found : peaks)
    hypotheses.insert(hypotheses.end(), found.begin(), found.end());
  return hypotheses;
}
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/ppf_matcher.hpp"

#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/ppf.hpp"

#include "vote_kernel.hpp"
#include "vote_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// The scene points around a reference point as arrays, and the pairs with it.
struct Neighborhood
{
  std::vector<std::uint32_t> near;
  PointArrays points;
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> alphas;
  std::vector<std::uint32_t> weights;
};

/// Votes over (model reference point, alpha bin) for one scene reference point.
class Accumulator
{
public:
  void reset(std::size_t references, std::uint32_t alpha_bins)
  {
    grid_ = {alpha_bins, 0};
    while ((1U << grid_.row_shift) < alpha_bins)
      ++grid_.row_shift;
    cells_.assign(references << grid_.row_shift, 0);
  }

  void add(const VoteTable& table, const Neighborhood& around)
  {
    addVotes(table, grid_, around.keys.size(), around.keys.data(), around.alphas.data(),
             around.weights.data(), cells_.data());
  }

  const std::vector<std::uint32_t>& cells() const { return cells_; }
  std::uint32_t votes(std::uint32_t cell) const { return cells_[cell]; }
  std::uint32_t reference(std::uint32_t cell) const { return cell >> grid_.row_shift; }

  /// The alpha [rad] of a cell: the centre of mass of the cell and its two neighbours round the
  /// circle.
  float alpha(std::uint32_t cell) const
  {
    const std::uint32_t bins = grid_.alpha_bins;
    const std::uint32_t first = reference(cell) << grid_.row_shift;
    const std::uint32_t bin = cell - first;
    const auto before = static_cast<float>(cells_[first + (bin + bins - 1) % bins]);
    const auto here = static_cast<float>(cells_[cell]);
    const auto after = static_cast<float>(cells_[first + (bin + 1) % bins]);
    const float offset = (after - before) / (before + here + after);
    const float step_rad = 2 * static_cast<float>(M_PI) / static_cast<float>(bins);
    return (static_cast<float>(bin) + 0.5F + offset) * step_rad;
  }

private:
  VoteGrid grid_{1, 0};
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

void lookAround(const Matching& matching, std::uint32_t reference, Neighborhood& around)
{
  const OrientedPoints& scene = matching.scene;
  const DetectorConfig& config = matching.config;
  const Eigen::Vector3f &p1 = scene.points[reference], &n1 = scene.normals[reference];
  matching.search.withinInAnyOrder(p1, matching.model.diameter_m, around.near);
  const std::size_t count = around.near.size();
  around.points.resize(count);
  around.keys.resize(count);
  around.alphas.resize(count);
  around.weights.assign(count, kVoteUnit);
  for (std::size_t k = 0; k < count; ++k)
  {
    const Eigen::Vector3f& n2 = scene.normals[around.near[k]];
    around.points.set(k, scene.points[around.near[k]].data(), n2.data());
    if (config.lambda > 0) around.weights[k] = voteWeight(n1, n2, config.lambda, config.v_min);
  }
  pairKeys(around.points, pairReference(p1, n1), matching.quantizer.steps(), around.keys.data(),
           around.alphas.data());
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
    thread_local Neighborhood around;
    thread_local Accumulator accumulator;
    const auto reference = static_cast<std::uint32_t>(i * scene.size() / references);
    accumulator.reset(std::max<std::size_t>(1, model.references()),
                      static_cast<std::uint32_t>(config.model.n_angle));
    lookAround(matching, reference, around);
    accumulator.add({data.offsets.data(), data.entries.data()}, around);
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

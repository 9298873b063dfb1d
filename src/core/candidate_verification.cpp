#include "ppf_bin_picking/core/candidate_verification.hpp"

#include "ppf_bin_picking/core/evidence_climb.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"
#include "ppf_bin_picking/core/sparse_fit.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace ppf_bin_picking
{
namespace
{
constexpr double kReachedRel = 0.02;   // a candidate nearer than this has come to a look-alike
constexpr double kReached_rad = 0.05;  // ... and turned by less
constexpr double kLittle = 0.3;  // balance of evidence, per confirmed pixel, that needs no climb
constexpr double kStrangeShare = 0.5;  // of the edges, where another surface runs on: no climb
constexpr std::size_t kBatch = 32;     // candidates between two looks at the deadline

/// True if a pose is worth a climb: the cloud says little for it, but not that it lies within
/// another surface. There a climb would find the place that hides best what is wrong.
bool shouldClimb(const PoseEvidence& evidence)
{
  const double weight = evidence.confirmed_weight;
  const double strange_px = static_cast<double>(evidence.goes_on.size()) + evidence.pierced;
  return evidenceBalance(evidence, weight) < kLittle * weight &&
         strange_px <= kStrangeShare * evidence.edgesInSight();
}

/// Leaves the candidates that are kept, in their order.
void keepOnly(const std::vector<std::uint8_t>& given_up, std::vector<Candidate>& candidates)
{
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!given_up[i]) kept.push_back(std::move(candidates[i]));
  candidates = std::move(kept);
}

/// Drops candidates that the cloud contradicts even where a quick fit moves them. They keep their
/// own poses: without the outline the fit slides, which the dear one would have to undo. Drops
/// nothing once the deadline has passed.
void dropHopeless(const RangeImage& image, const std::vector<const PpfModel*>& models,
                  const DetectorConfig& config, const Deadline& deadline,
                  std::vector<Candidate>& candidates)
{
  std::vector<std::uint8_t> hopeless(candidates.size(), 0);
  const auto judge = [&](std::size_t i)
  {
    if (deadline.passed()) return;
    const Candidate& start = candidates[i];
    const SparseFit fit = fitSparsely(image, *models[start.model], start.T_camera_model, config);
    hopeless[i] = fit.balance < config.min_sparse_balance;
  };
  parallelFor(config.threads, candidates.size(), judge);
  if (!deadline.passed()) keepOnly(hopeless, candidates);
}

/// Indices of the candidates by their distance from the one with the most votes.
std::vector<std::size_t> fromTheBestOutwards(const std::vector<Candidate>& candidates,
                                             const std::vector<const PpfModel*>& models)
{
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (candidates.empty()) return order;
  std::vector<Eigen::Vector3f> centers;
  for (const Candidate& candidate : candidates)
    centers.push_back(candidate.T_camera_model * models[candidate.model]->data().center);
  const auto best =
      std::max_element(candidates.begin(), candidates.end(),
                       [](const auto& a, const auto& b) { return a.votes < b.votes; });
  const Eigen::Vector3f start = centers[static_cast<std::size_t>(best - candidates.begin())];
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b)
                   { return (centers[a] - start).norm() < (centers[b] - start).norm(); });
  return order;
}

/// Refines some candidates. Returns those that the cloud does not contradict after the first look;
/// the others are given up.
std::vector<std::size_t> refineBatch(const RangeImage& image,
                                     const std::vector<const PpfModel*>& models,
                                     const DetectorConfig& config,
                                     const std::vector<std::size_t>& batch,
                                     std::vector<Candidate>& candidates,
                                     std::vector<std::uint8_t>& given_up)
{
  const auto refine = [&](std::size_t k)
  {
    Candidate& candidate = candidates[batch[k]];
    const PpfModel& model = *models[candidate.model];
    Refinement refinement{candidate.T_camera_model};
    refineByOneLook(image, model, config, refinement);
    given_up[batch[k]] = refinement.balance < config.min_look_balance;
    while (!refinement.done && !given_up[batch[k]])
      refineByOneLook(image, model, config, refinement);
    candidate.T_camera_model = refinement.T_camera_model;
  };
  parallelFor(config.threads, batch.size(), refine);
  std::vector<std::size_t> kept;
  std::copy_if(batch.begin(), batch.end(), std::back_inserter(kept),
               [&](std::size_t i) { return !given_up[i]; });
  return kept;
}
}  // namespace

void verifyCandidates(const RangeImage& image, const std::vector<const PpfModel*>& models,
                      const DetectorConfig& config, const Deadline& deadline,
                      const std::function<void(const char*)>& lap,
                      std::vector<Candidate>& candidates)
{
  dropHopeless(image, models, config, deadline, candidates);
  lap("pruning");
  const std::vector<std::size_t> order = fromTheBestOutwards(candidates, models);
  std::vector<std::uint8_t> given_up(candidates.size(), 0);
  for (std::size_t first = 0; first < order.size() && !deadline.passed(); first += kBatch)
  {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t count = std::min(kBatch, order.size() - first);
    const std::vector<std::size_t> batch =
        refineBatch(image, models, config, {begin, begin + static_cast<std::ptrdiff_t>(count)},
                    candidates, given_up);
    lap("refinement");
    const auto verify = [&](std::size_t i)
    {
      Candidate& candidate = candidates[batch[i]];
      candidate.evidence =
          gatherEvidence(image, *models[candidate.model], candidate.T_camera_model, config);
      candidate.verified = true;
    };
    parallelFor(config.threads, batch.size(), verify);
    lap("verification");
  }
  keepOnly(given_up, candidates);
}

std::vector<Candidate> lookAlikesOf(const std::vector<const PpfModel*>& models,
                                    const DetectorConfig& config,
                                    const std::vector<Candidate>& candidates,
                                    const std::vector<SelectedPose>& selected)
{
  std::vector<Candidate> turned;
  for (const SelectedPose& standing : selected)
  {
    const Candidate& pose = candidates[standing.candidate];
    if (poseScore(pose.evidence, standing.confirmed) < config.min_score) continue;
    for (const Eigen::Isometry3f& turn : models[pose.model]->lookAlikes())
    {
      Candidate candidate;
      candidate.model = pose.model;
      candidate.cluster = pose.cluster;
      candidate.votes = pose.votes;
      candidate.T_camera_model = pose.T_camera_model * turn;
      const auto is_here = [&](const Candidate& other)
      {
        return other.verified &&
               areNear(other, candidate, *models[pose.model], kReachedRel, kReached_rad);
      };
      if (std::none_of(candidates.begin(), candidates.end(), is_here)) turned.push_back(candidate);
    }
  }
  return turned;
}

bool climbStanding(const RangeImage& image, const std::vector<const PpfModel*>& models,
                   const DetectorConfig& config, const Deadline& deadline,
                   const std::vector<SelectedPose>& selected, std::vector<Candidate>& candidates)
{
  std::atomic<bool> all(true);
  const auto climb = [&](std::size_t i)
  {
    Candidate& pose = candidates[selected[i].candidate];
    if (!shouldClimb(pose.evidence)) return;
    if (deadline.passed())
    {
      all = false;
      return;
    }
    const double before = seenBalance(pose.evidence, pose.evidence.confirmed_weight);
    Climb climb =
        climbEvidence(image, *models[pose.model], pose.T_camera_model, pose.evidence, config);
    pose.T_camera_model = climb.T_camera_model;
    pose.evidence = std::move(climb.evidence);
    pose.climbed =
        std::max(0.0, seenBalance(pose.evidence, pose.evidence.confirmed_weight) - before);
  };
  parallelFor(config.threads, selected.size(), climb);
  return all;
}
}  // namespace ppf_bin_picking

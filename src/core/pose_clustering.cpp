#include "ppf_bin_picking/core/pose_clustering.hpp"

#include "ppf_bin_picking/core/dbscan.hpp"
#include "ppf_bin_picking/core/pca.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppf_bin_picking
{
namespace
{
constexpr double kEpsPerStep = 1.0;
constexpr double kVisibleShare = 0.25;  // of a model's points that a camera sees of a part, about
constexpr double kCoreShare = 0.05;     // of those that are reference points
constexpr std::size_t kLeastCoreSize = 3;

std::vector<PoseHypothesis> ofCluster(const std::vector<PoseHypothesis>& hypotheses,
                                      std::int32_t cluster)
{
  std::vector<PoseHypothesis> members;
  std::copy_if(hypotheses.begin(), hypotheses.end(), std::back_inserter(members),
               [&](const PoseHypothesis& hypothesis) { return hypothesis.cluster == cluster; });
  return members;
}

bool moreVotes(const PoseGroup& a, const PoseGroup& b)
{
  return a.votes > b.votes;
}
}  // namespace

std::vector<PoseHypothesis> highVoteHypotheses(const std::vector<PoseHypothesis>& hypotheses,
                                               double min_votes_rel)
{
  float most = 0;
  for (const PoseHypothesis& hypothesis : hypotheses)
    most = std::max(most, hypothesis.votes);
  const float least = static_cast<float>(min_votes_rel) * most;
  std::vector<PoseHypothesis> high;
  std::copy_if(hypotheses.begin(), hypotheses.end(), std::back_inserter(high),
               [&](const PoseHypothesis& hypothesis) { return hypothesis.votes >= least; });
  return high;
}

double dbscanRadius(const DetectorConfig& config, const PpfModel& model)
{
  const double eps_rel =
      config.eps_rel > 0 ? config.eps_rel : kEpsPerStep * model.parameters().step_rel;
  return eps_rel * model.diameter();
}

std::size_t dbscanCoreSize(const DetectorConfig& config, const PpfModel& model)
{
  if (config.minpts > 0) return static_cast<std::size_t>(config.minpts);
  const double visible =
      kVisibleShare * config.reference_share * static_cast<double>(model.data().points.size());
  return std::max(kLeastCoreSize, static_cast<std::size_t>(std::lround(kCoreShare * visible)));
}

std::vector<HypothesisCluster> clusterHypotheses(const DetectorConfig& config,
                                                 const PpfModel& model,
                                                 std::vector<PoseHypothesis>& hypotheses)
{
  std::vector<Eigen::Vector3f> centers;
  for (const PoseHypothesis& hypothesis : hypotheses)
    centers.push_back(hypothesis.center);
  const std::vector<std::int32_t> labels = dbscan(
      centers, static_cast<float>(dbscanRadius(config, model)), dbscanCoreSize(config, model));
  std::vector<std::vector<Eigen::Vector3f>> members;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    hypotheses[i].cluster = labels[i];
    if (labels[i] == kNoise) continue;
    members.resize(std::max(members.size(), static_cast<std::size_t>(labels[i]) + 1));
    members[static_cast<std::size_t>(labels[i])].push_back(centers[i]);
  }
  std::vector<HypothesisCluster> clusters;
  for (const std::vector<Eigen::Vector3f>& points : members)
  {
    HypothesisCluster cluster;
    cluster.box = principalBox(points);
    cluster.hypotheses = points.size();
    cluster.mismatching = sideSum(cluster.box) > config.max_spread_rel * model.diameter();
    clusters.push_back(cluster);
  }
  return clusters;
}

std::vector<PoseGroup> groupPoses(const DetectorConfig& config, const PpfModel& model,
                                  const std::vector<PoseHypothesis>& hypotheses)
{
  std::vector<std::uint32_t> order(hypotheses.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return hypotheses[a].votes > hypotheses[b].votes; });
  const auto radius_m = static_cast<float>(config.group_distance_rel * model.diameter());
  std::vector<PoseGroup> groups;
  std::vector<Eigen::Vector3f> leaders;  // centres of the groups' best members
  for (const std::uint32_t i : order)
  {
    const PoseHypothesis& hypothesis = hypotheses[i];
    std::size_t g = 0;
    while (g < groups.size() &&
           ((leaders[g] - hypothesis.center).squaredNorm() > radius_m * radius_m ||
            model.symmetries().rotationDistance(groups[g].rotation, hypothesis.rotation) >
                config.group_angle_rad))
      ++g;
    if (g == groups.size())
    {
      groups.push_back({hypothesis.rotation, Eigen::Vector3f::Zero(), 0, hypothesis.cluster, 0});
      leaders.push_back(hypothesis.center);
    }
    groups[g].center += hypothesis.votes * hypothesis.center;
    groups[g].votes += hypothesis.votes;
    ++groups[g].members;
  }
  for (PoseGroup& group : groups)
    group.center /= group.votes;
  std::stable_sort(groups.begin(), groups.end(), moreVotes);
  return groups;
}

std::vector<PoseGroup> candidatePoses(const DetectorConfig& config, const PpfModel& model,
                                      const std::vector<PoseHypothesis>& hypotheses,
                                      std::size_t clusters)
{
  if (config.clustering == Clustering::kGreedy) return groupPoses(config, model, hypotheses);
  std::vector<PoseGroup> candidates;
  for (std::size_t c = 0; c < clusters; ++c)
  {
    std::vector<PoseGroup> groups =
        groupPoses(config, model, ofCluster(hypotheses, static_cast<std::int32_t>(c)));
    const auto wanted = static_cast<std::size_t>(config.poses_per_cluster);
    if (wanted > 0 && groups.size() > wanted) groups.resize(wanted);
    candidates.insert(candidates.end(), groups.begin(), groups.end());
  }
  std::stable_sort(candidates.begin(), candidates.end(), moreVotes);
  return candidates;
}
}  // namespace ppf_bin_picking

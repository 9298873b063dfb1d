#include "ppf_bin_picking/core/candidate_search.hpp"

#include "ppf_bin_picking/core/boundary_matcher.hpp"
#include "ppf_bin_picking/core/neighbor_search.hpp"
#include "ppf_bin_picking/core/pose_clustering.hpp"
#include "ppf_bin_picking/core/ppf_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ppf_bin_picking
{
namespace
{
constexpr float kPlaceRel =
    0.15F;  // candidates nearer than this share a place, relative to the diameter
constexpr float kJumpNoises = 4;  // a fall beyond a boundary is at least so many of the noise
constexpr std::size_t kMaxPerPlace = 6;  // so that turns of one part do not crowd out the others

/// The groups worth refining: most votes first, a few a place.
std::vector<PoseGroup> worthRefining(const std::vector<PoseGroup>& groups, std::size_t most,
                                     float place_m)
{
  std::vector<PoseGroup> chosen;
  for (const PoseGroup& group : groups)
  {
    if (chosen.size() == most) break;
    const auto here = std::count_if(chosen.begin(), chosen.end(),
                                    [&](const PoseGroup& other)
                                    { return (other.center - group.center).norm() < place_m; });
    if (static_cast<std::size_t>(here) < kMaxPerPlace) chosen.push_back(group);
  }
  return chosen;
}

/// T_camera_model of a pose about the part's centre.
Eigen::Isometry3f poseOf(const Eigen::Quaternionf& rotation, const Eigen::Vector3f& center_camera,
                         const Eigen::Vector3f& center_model)
{
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.linear() = rotation.toRotationMatrix();
  pose.translation() = center_camera - pose.linear() * center_model;
  return pose;
}

/// Gives each group the cluster of the nearest hypothesis within a radius, so that what is known of
/// a mismatching region holds for every pose in it.
void joinClusters(const std::vector<PoseHypothesis>& distribution, float radius_m,
                  std::vector<PoseGroup>& groups)
{
  std::vector<Eigen::Vector3f> centers;
  for (const PoseHypothesis& hypothesis : distribution)
    centers.push_back(hypothesis.center);
  if (centers.empty()) return;
  const NeighborSearch search(centers);
  std::vector<std::pair<std::uint32_t, float>> nearest;
  for (PoseGroup& group : groups)
  {
    search.nearest(group.center, 1, nearest);
    const auto& [index, squared_distance] = nearest.front();
    group.cluster = squared_distance < radius_m * radius_m ? distribution[index].cluster : -1;
  }
}

/// What the boundary votes for.
std::vector<PoseGroup> boundaryPoses(const RangeImage& image, const PpfModel& model,
                                     const DetectorConfig& config, const Deadline& deadline,
                                     const std::vector<PoseHypothesis>& distribution)
{
  std::vector<PoseGroup> groups = groupPoses(
      config, model,
      highVoteHypotheses(boundaryHypotheses(image, model, config, deadline), config.min_votes_rel));
  joinClusters(distribution, static_cast<float>(dbscanRadius(config, model)), groups);
  return groups;
}

/// Appends what one model's votes say of the scene.
void append(std::vector<HypothesisCluster>& clusters, std::vector<PoseHypothesis>& distribution,
            std::uint32_t model, DetectionResult& result)
{
  const auto first_cluster = static_cast<std::int32_t>(result.clusters.size());
  for (HypothesisCluster& cluster : clusters)
    cluster.model = model;
  for (PoseHypothesis& hypothesis : distribution)
  {
    hypothesis.model = model;
    if (hypothesis.cluster >= 0) hypothesis.cluster += first_cluster;
  }
  result.clusters.insert(result.clusters.end(), clusters.begin(), clusters.end());
  result.distribution.insert(result.distribution.end(), distribution.begin(), distribution.end());
}
}  // namespace

bool areNear(const Candidate& a, const Candidate& b, const PpfModel& model, double distance_rel,
             double angle_rad)
{
  const Eigen::Vector3f& center = model.data().center;
  return a.model == b.model &&
         (a.T_camera_model * center - b.T_camera_model * center).norm() <
             distance_rel * model.diameter() &&
         model.symmetries().rotationDistance(Eigen::Quaternionf(a.T_camera_model.linear()),
                                             Eigen::Quaternionf(b.T_camera_model.linear())) <
             angle_rad;
}

OrientedPoints sampleScene(const RangeImage& image, float step_m)
{
  OrientedPoints cloud;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u)
    {
      const std::size_t i = image.index(u, v);
      if (image.in_roi[i] && !image.normals[i].isZero())
        cloud.add(image.point(u, v), image.normals[i]);
    }
  return thinOut(cloud, step_m);
}

std::vector<PoseHypothesis> boundaryHypotheses(const RangeImage& image, const PpfModel& model,
                                               const DetectorConfig& config,
                                               const Deadline& deadline)
{
  const auto diameter_m = static_cast<float>(model.diameter());
  const float jump_m =
      std::max(boundaryJump(diameter_m), kJumpNoises * static_cast<float>(image.noise_m));
  const std::vector<BoundaryPoint> boundary =
      thinOutBoundary(boundaryOf(image, jump_m, config.threads), boundarySpacing(diameter_m));
  return matchBoundary(boundary, model, config, deadline);
}

void searchCandidates(const RangeImage& image, const PpfModel& model, std::uint32_t model_index,
                      const DetectorConfig& config, const Deadline& deadline,
                      const std::function<void(const char*)>& lap, DetectionResult& result,
                      std::vector<Candidate>& candidates)
{
  const OrientedPoints scene =
      sampleScene(image, static_cast<float>(config.model.step_rel * model.diameter()));
  if (model_index == 0) result.scene_points = scene.points;
  lap("sampling");
  std::vector<PoseHypothesis> distribution =
      highVoteHypotheses(matchModel(scene, model, config, deadline), config.min_votes_rel);
  lap("voting");
  std::vector<HypothesisCluster> clusters;
  if (config.clustering == Clustering::kDbscan)
    clusters = clusterHypotheses(config, model, distribution);
  lap("clustering");
  const float place_m = kPlaceRel * static_cast<float>(model.diameter());
  const auto most = static_cast<std::size_t>(config.max_candidates + 1) / 2;  // of either kind
  std::vector<PoseGroup> groups =
      worthRefining(candidatePoses(config, model, distribution, clusters.size()), most, place_m);
  lap("grouping");
  const std::vector<PoseGroup> by_boundary =
      worthRefining(boundaryPoses(image, model, config, deadline, distribution), most, place_m);
  groups.insert(groups.end(), by_boundary.begin(), by_boundary.end());
  lap("boundary voting");

  const auto first_cluster = static_cast<std::int32_t>(result.clusters.size());
  for (const PoseGroup& group : groups)
  {
    Candidate candidate;
    candidate.model = model_index;
    candidate.cluster = group.cluster < 0 ? -1 : group.cluster + first_cluster;
    candidate.votes = group.votes;
    candidate.T_camera_model = poseOf(group.rotation, group.center, model.data().center);
    candidates.push_back(candidate);
  }
  append(clusters, distribution, model_index, result);
}
}  // namespace ppf_bin_picking

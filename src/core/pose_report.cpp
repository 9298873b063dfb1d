#include "ppf_bin_picking/core/pose_report.hpp"

#include "ppf_bin_picking/core/ambiguity.hpp"
#include "ppf_bin_picking/core/canonical_pose.hpp"
#include "ppf_bin_picking/core/mismatch.hpp"
#include "ppf_bin_picking/core/parallel.hpp"
#include "ppf_bin_picking/core/pca.hpp"
#include "ppf_bin_picking/core/pose_covariance.hpp"
#include "ppf_bin_picking/core/pose_information.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"
#include "ppf_bin_picking/core/pose_verdict.hpp"
#include "ppf_bin_picking/core/reliability.hpp"

#include <algorithm>
#include <tuple>

namespace ppf_bin_picking
{
namespace
{
/// The part's box at a pose, along the mesh's axes.
OrientedBox boxOfPart(const PpfModel& model, const Eigen::Isometry3d& T_cloud_model)
{
  Eigen::AlignedBox3f extent;
  for (const Eigen::Vector3f& vertex : model.data().mesh.vertices)
    extent.extend(vertex);
  OrientedBox box;
  box.size = extent.sizes().cast<double>();
  box.T_cloud_box = T_cloud_model * Eigen::Translation3d(extent.center().cast<double>());
  return box;
}

/// Writes where the part is: the canonical pose of its orbit.
void setPose(const Eigen::Isometry3f& T_cloud_model, const PpfModel& model, DetectedPose& pose)
{
  pose.T_cloud_model = T_cloud_model.cast<double>();
  pose.T_cloud_model.linear() =
      Eigen::Quaterniond(pose.T_cloud_model.linear()).normalized().toRotationMatrix();
  pose.T_cloud_model = canonicalPose(pose.T_cloud_model, model.symmetries());
}

DetectedPose poseOfCandidate(const Candidate& candidate, const PpfModel& model, double confirmed,
                             double balance)
{
  DetectedPose pose;
  pose.model = candidate.model;
  setPose(candidate.T_camera_model, model, pose);
  pose.score = poseScore(candidate.evidence, confirmed);
  pose.votes = candidate.votes;
  pose.visible_fraction = visibleFraction(candidate.evidence);
  pose.rms_error_m = candidate.evidence.rms_error_m;
  pose.support = candidate.evidence.support();
  pose.confirmed_px = static_cast<int>(candidate.evidence.confirmed.size());
  pose.evidence_balance = balance / std::max(1.0, candidate.evidence.confirmed_weight);
  const PoseEvidence& evidence = candidate.evidence;
  const double expected = std::max(1.0, evidence.expected());
  pose.looked_through = evidence.looked_through / expected;
  const double edges_px = evidence.edgesInSight();
  pose.outline_broken = (evidence.outline_broken + evidence.pierced) / edges_px;
  pose.pierced = evidence.pierced / edges_px;
  pose.claimed = (evidence.confirmed_weight - confirmed) / expected;
  pose.cluster = candidate.cluster;
  return pose;
}

/// How firmly each standing pose is held.
std::vector<float> holdsOf(const RangeImage& image, const std::vector<const PpfModel*>& models,
                           const DetectorConfig& config, const std::vector<Candidate>& candidates,
                           const std::vector<SelectedPose>& selected)
{
  std::vector<float> holds(selected.size());
  const auto hold = [&](std::size_t i)
  {
    const Candidate& pose = candidates[selected[i].candidate];
    const PpfModel& model = *models[pose.model];
    holds[i] = gatherInformation(image, model, pose.T_camera_model, config)
                   .hold(model, pose.T_camera_model);
  };
  parallelFor(config.threads, selected.size(), hold);
  return holds;
}

/// All that is known of each standing pose by itself and beside its rivals.
std::vector<DetectedPose> standingPoses(const std::vector<const PpfModel*>& models,
                                        const std::vector<Candidate>& candidates,
                                        const std::vector<SelectedPose>& selected,
                                        const std::vector<Ambiguity>& ambiguities,
                                        const std::vector<float>& holds)
{
  std::vector<DetectedPose> poses;
  for (std::size_t i = 0; i < selected.size(); ++i)
  {
    const Candidate& candidate = candidates[selected[i].candidate];
    DetectedPose pose = poseOfCandidate(candidate, *models[candidate.model], selected[i].confirmed,
                                        selected[i].balance);
    pose.slide_share = ambiguities[i].slide_share;
    pose.goes_on = ambiguities[i].goes_on_px / candidate.evidence.edgesInSight();
    pose.margin = ambiguities[i].margin;
    pose.hold = holds[i];
    poses.push_back(pose);
  }
  return poses;
}

/// Writes how far the hypotheses of each pose spread: all of its cluster's if its outline lets it
/// slide, as the whole cluster may be one pose sliding then, else its share of them.
/// @param shares  Of each pose; those of poses that may slide become the whole cluster's.
void addSpreads(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                const std::vector<HypothesisCluster>& clusters, std::vector<ClusterShare>& shares,
                std::vector<DetectedPose>& poses)
{
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    DetectedPose& pose = poses[i];
    if (pose.cluster >= 0 && pose.slide_share > config.max_slide_share)
    {
      const HypothesisCluster& cluster = clusters[static_cast<std::size_t>(pose.cluster)];
      shares[i] = {cluster.box, cluster.hypotheses};
    }
    pose.spread = sideSum(shares[i].box) / models[pose.model]->diameter();
  }
}

/// Takes the standing poses through the gates, each with the reliability already written.
std::vector<PoseVerdict> verdictsOf(const std::vector<const PpfModel*>& models,
                                    const DetectorConfig& config,
                                    const std::vector<Ambiguity>& ambiguities,
                                    const std::vector<ClusterShare>& shares,
                                    const std::vector<DetectedPose>& poses)
{
  std::vector<PoseVerdict> verdicts;
  for (std::size_t i = 0; i < poses.size(); ++i)
    verdicts.push_back(verdictOf(poses[i], ambiguities[i].rivals_known, shares[i],
                                 *models[poses[i].model], config));
  return verdicts;
}

void addReliabilities(bool whole_cloud, std::vector<DetectedPose>& poses)
{
  for (DetectedPose& pose : poses)
  {
    const Reliability reliability = assessReliability(pose, whole_cloud);
    pose.reliability = reliability.probability;
    pose.main_doubt = reliability.main_doubt;
  }
}

/// Judges the standing poses: first as if nothing were usual, then by what those show that pass so.
std::vector<PoseVerdict> judge(const std::vector<const PpfModel*>& models,
                               const DetectorConfig& config,
                               const std::vector<Ambiguity>& ambiguities,
                               const std::vector<ClusterShare>& shares, bool whole_cloud,
                               std::vector<DetectedPose>& poses)
{
  DetectorConfig showing = config;
  showing.mismatch_test = true;
  showing.min_reliability = kShowsUsual;
  addReliabilities(whole_cloud, poses);
  std::vector<bool> shows;
  for (const PoseVerdict& verdict : verdictsOf(models, showing, ambiguities, shares, poses))
    shows.push_back(verdict.reason == UnreliableReason::kNone);
  setUsualShares(shows, poses);
  addReliabilities(whole_cloud, poses);
  return verdictsOf(models, config, ambiguities, shares, poses);
}

/// Lets the reliable poses settle, as the others stay where their regions show them, and writes
/// each pose's covariance.
void settleAndAddCovariances(const RangeImage& image, const std::vector<const PpfModel*>& models,
                             const DetectorConfig& config, std::vector<DetectedPose>& poses)
{
  const auto finish = [&](std::size_t i)
  {
    DetectedPose& pose = poses[i];
    const PpfModel& model = *models[pose.model];
    if (pose.reliable)
      setPose(settlePose(image, model, pose.T_cloud_model.cast<float>(), config), model, pose);
    pose.covariance = poseCovariance(image, model, pose.T_cloud_model, config);
  };
  parallelFor(config.threads, poses.size(), finish);
}

/// What each standing pose has of its cluster's hypotheses.
std::vector<ClusterShare> sharesOf(const std::vector<const PpfModel*>& models,
                                   const std::vector<Candidate>& candidates,
                                   const std::vector<SelectedPose>& selected,
                                   const DetectionResult& result)
{
  std::vector<Eigen::Vector3f> centers;
  std::vector<std::int32_t> clusters;
  for (const SelectedPose& standing : selected)
  {
    const Candidate& candidate = candidates[standing.candidate];
    centers.push_back(candidate.T_camera_model * models[candidate.model]->data().center);
    clusters.push_back(candidate.cluster);
  }
  return shareClusters(result.distribution, centers, clusters);
}

/// Mismatching clusters in which no pose stands, each with its best candidate.
void addDesertedClusters(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                         const std::vector<Candidate>& candidates,
                         const std::vector<SelectedPose>& selected, DetectionResult& result)
{
  std::vector<bool> has_pose(result.clusters.size(), false);
  for (const SelectedPose& standing : selected)
  {
    const std::int32_t cluster = candidates[standing.candidate].cluster;
    if (cluster >= 0) has_pose[static_cast<std::size_t>(cluster)] = true;
  }
  for (std::size_t c = 0; c < result.clusters.size(); ++c)
  {
    const HypothesisCluster& cluster = result.clusters[c];
    if (!cluster.mismatching || has_pose[c]) continue;
    const auto best = std::find_if(candidates.begin(), candidates.end(),
                                   [&](const Candidate& candidate)
                                   { return candidate.cluster == static_cast<std::int32_t>(c); });
    if (best == candidates.end()) continue;  // all of its poses were given up
    const PpfModel& model = *models[best->model];
    const DetectedPose pose = poseOfCandidate(*best, model, best->evidence.confirmed_weight, 0.0);
    const ClusterShare whole = {cluster.box, cluster.hypotheses};
    result.regions.push_back(
        regionOf(pose, model, verdictOf(pose, true, whole, model, config), whole));
  }
}
}  // namespace

MismatchingRegion regionOf(const DetectedPose& pose, const PpfModel& model,
                           const PoseVerdict& verdict, const ClusterShare& share)
{
  MismatchingRegion region;
  region.model = pose.model;
  region.reason = verdict.reason;
  region.box = verdict.reason == UnreliableReason::kSpread ? share.box
                                                           : boxOfPart(model, pose.T_cloud_model);
  region.T_cloud_best = pose.T_cloud_model;
  region.score = pose.score;
  region.reliability = pose.reliability;
  region.hypotheses = share.hypotheses;
  region.detail = verdict.detail;
  return region;
}

void sortResult(DetectionResult& result)
{
  std::stable_sort(result.poses.begin(), result.poses.end(),
                   [](const DetectedPose& a, const DetectedPose& b)
                   {
                     return std::make_tuple(a.reliable, a.reliability, a.score) >
                            std::make_tuple(b.reliable, b.reliability, b.score);
                   });
  std::stable_sort(result.regions.begin(), result.regions.end(),
                   [](const MismatchingRegion& a, const MismatchingRegion& b)
                   { return a.score > b.score; });
}

std::vector<SelectedPose> selectCandidates(const std::vector<Candidate>& candidates,
                                           std::size_t pixels)
{
  std::vector<const PoseEvidence*> evidence;
  for (const Candidate& candidate : candidates)
    evidence.push_back(&candidate.evidence);
  return selectPoses(evidence, pixels);
}

void reportPoses(const std::vector<const PpfModel*>& models, const DetectorConfig& config,
                 const std::vector<Candidate>& candidates,
                 const std::vector<SelectedPose>& selected, const RangeImage& image,
                 DetectionResult& result)
{
  std::vector<ClusterShare> shares = sharesOf(models, candidates, selected, result);
  const std::vector<Ambiguity> ambiguities =
      assessAmbiguity(models, config, candidates, selected, image.depth.size());
  result.poses = standingPoses(models, candidates, selected, ambiguities,
                               holdsOf(image, models, config, candidates, selected));
  addSpreads(models, config, result.clusters, shares, result.poses);
  const std::vector<PoseVerdict> verdicts =
      judge(models, config, ambiguities, shares, image.whole_cloud, result.poses);
  for (std::size_t i = 0; i < result.poses.size(); ++i)
  {
    DetectedPose& pose = result.poses[i];
    pose.reason = verdicts[i].reason;
    pose.reliable = pose.reason == UnreliableReason::kNone;
    if (!pose.reliable)
      result.regions.push_back(regionOf(pose, *models[pose.model], verdicts[i], shares[i]));
  }
  settleAndAddCovariances(image, models, config, result.poses);
  if (config.mismatch_test) addDesertedClusters(models, config, candidates, selected, result);
  sortResult(result);
}
}  // namespace ppf_bin_picking

/// @file Every tunable of the detector, its default and its rule. config/detector.yaml repeats the
/// defaults.
#pragma once

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// How the pose hypotheses are gathered.
enum class Clustering
{
  kDbscan,  ///< DBSCAN over the parts' centres, then greedy grouping inside each cluster.
  kGreedy,  ///< Greedy grouping over all hypotheses, as in Drost 2010; no mismatching regions.
};

/// What decides the content of a trained model. A model and a detector must agree on all of it.
struct ModelParameters
{
  double step_rel = 0.07;  ///< Distance step and sampling distance. In [0.01, 0.2].
  int n_angle = 30;        ///< Angle steps in a full turn: a step is 2 pi / n_angle. In [8, 120].

  bool operator==(const ModelParameters& other) const
  {
    return step_rel == other.step_rel && n_angle == other.n_angle;
  }
};

/// A pose that scores less is not worth showing.
constexpr double kLeastScore = 0.4;

/// Everything the detector can be tuned with. `_rel` is relative to the part's diameter, `_share` a
/// share in [0, 1], `_px` pixels of the working image, `_rad` radians, `_s` seconds.
struct DetectorConfig
{
  // Model and sampling (training again after a change)
  ModelParameters model;

  // Scene
  int max_points = 5000000;          ///< A larger cloud is refused. >= 1.
  bool use_cloud_normals = false;    ///< Take the cloud's own normals instead of computing them.
  double pixels_per_diameter = 100;  ///< Resolution that the image is averaged down to. >= 20.
  int normal_radius_px = 2;  ///< Least half window of the plane fits in the image. In [1, 10].

  // Voting
  double reference_share = 0.1;  ///< Share of the scene points that are reference points. (0, 1].
  double lambda = 0.0;           ///< Weight of a vote: max(v_min, 1 - lambda |n1 . n2|). [0, 1].
  double v_min = 0.1;            ///< Smallest weight of a vote. (0, 1].
  int peaks_per_reference = 5;   ///< Peaks kept of each reference point's accumulator. [1, 10].
  double peak_ratio = 0.9;       ///< Further peaks reach this share of the best. (0, 1].

  // Clustering
  Clustering clustering = Clustering::kDbscan;  ///< `dbscan` or `greedy`.
  double min_votes_rel = 0.1;  ///< High-vote gate, relative to the best hypothesis. [0, 1].
  double eps_rel = 0.0;        ///< DBSCAN radius. 0: from the sampling step. >= 0.
  int minpts = 0;  ///< DBSCAN core size, the point included. 0: from the reference share.
  double group_distance_rel = 0.1;  ///< Poses nearer than this group. > 0.
  double group_angle_rad = 0.35;    ///< Poses turned by less than this group. (0, pi].
  int poses_per_cluster = 0;  ///< Poses of a cluster that are verified; 0: all, 1: as in the paper.

  // Mismatching regions
  bool mismatch_test = true;    ///< False: score, visible share and confirmed pixels alone decide.
  double max_spread_rel = 1.5;  ///< Largest sum of a cluster's box sides. > 0.
  /// Largest share of open outline; beyond it a pose answers for the spread of its whole cluster,
  /// and is not reliable if it is held loosely. [0, 1].
  double max_slide_share = 0.85;
  double firm_hold = 0.07;          ///< From this hold on a pose is not held loosely. >= 0.
  double max_outline_broken = 0.7;  ///< Largest broken share of the edges in sight. [0, 1].
  /// Largest share of these that the cloud passes through, beyond the usual one. [0, 1].
  double max_pierced = 0.3;
  double min_margin = 0.05;      ///< Least lead over the best other pose there. [-1, 1].
  double min_reliability = 0.9;  ///< Least probability that a pose is right. [0, 1].

  // Refinement, verification and selection
  int max_candidates = 300;          ///< Poses that are refined and verified at most. >= 1.
  double min_sparse_balance = -0.6;  ///< A quick fit worse than this ends a pose. [-2, 1].
  double min_look_balance = -0.2;    ///< ... or worse than this after the first look. [-2, 1].
  int icp_iterations = 12;           ///< Steps of point-to-plane ICP. In [0, 100].
  bool climb = true;  ///< Poses that the cloud says little for climb, see evidence_climb.hpp.
  double depth_gate_rel = 0.02;    ///< A surface confirms a pose within this, see depthGate(). > 0.
  double normal_gate_rad = 0.6;    ///< ... and within this turn of the normal. (0, pi/2].
  double min_score = kLeastScore;  ///< Poses scoring less are not reliable. [kLeastScore, 1].
  double min_visible_share = 0.2;  ///< Poses showing less of their surface neither. [0, 1].
  int min_confirmed_px = 50;       ///< Poses confirmed by fewer pixels neither. >= 1.

  // Running
  int threads = 0;          ///< 0: one per core. >= 0.
  double time_limit_s = 0;  ///< After this time the detection ends with what it has. 0: none.

  /// One sentence per broken rule; empty means usable.
  std::vector<std::string> problems() const;
};

/// Calls visitor(name, field) for every field, in the order of the struct. The names are those of
/// YAML files and ROS parameters; fields are double, int, bool or Clustering. Readers, writers and
/// checks of configurations are visitors, so that a new field is named here alone.
template <class Config, class Visitor>
void visitFields(Config&& config, Visitor&& visit)
{
  visit("step_rel", config.model.step_rel);
  visit("n_angle", config.model.n_angle);
  visit("max_points", config.max_points);
  visit("use_cloud_normals", config.use_cloud_normals);
  visit("pixels_per_diameter", config.pixels_per_diameter);
  visit("normal_radius_px", config.normal_radius_px);
  visit("reference_share", config.reference_share);
  visit("lambda", config.lambda);
  visit("v_min", config.v_min);
  visit("peaks_per_reference", config.peaks_per_reference);
  visit("peak_ratio", config.peak_ratio);
  visit("clustering", config.clustering);
  visit("min_votes_rel", config.min_votes_rel);
  visit("eps_rel", config.eps_rel);
  visit("minpts", config.minpts);
  visit("group_distance_rel", config.group_distance_rel);
  visit("group_angle_rad", config.group_angle_rad);
  visit("poses_per_cluster", config.poses_per_cluster);
  visit("mismatch_test", config.mismatch_test);
  visit("max_spread_rel", config.max_spread_rel);
  visit("max_slide_share", config.max_slide_share);
  visit("firm_hold", config.firm_hold);
  visit("max_outline_broken", config.max_outline_broken);
  visit("max_pierced", config.max_pierced);
  visit("min_margin", config.min_margin);
  visit("min_reliability", config.min_reliability);
  visit("max_candidates", config.max_candidates);
  visit("min_sparse_balance", config.min_sparse_balance);
  visit("min_look_balance", config.min_look_balance);
  visit("icp_iterations", config.icp_iterations);
  visit("climb", config.climb);
  visit("depth_gate_rel", config.depth_gate_rel);
  visit("normal_gate_rad", config.normal_gate_rad);
  visit("min_score", config.min_score);
  visit("min_visible_share", config.min_visible_share);
  visit("min_confirmed_px", config.min_confirmed_px);
  visit("threads", config.threads);
  visit("time_limit_s", config.time_limit_s);
}

/// `dbscan` or `greedy`.
const char* toString(Clustering clustering);

/// Inverse of toString. @throw std::invalid_argument naming the word and the allowed ones.
Clustering clusteringFromString(const std::string& word);
}  // namespace ppf_bin_picking

/// @file What one detection returns: poses, regions, the distribution behind them, counts and
/// times.
#pragma once

#include "ppf_bin_picking/core/unreliable_reason.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// How a detection ended.
enum class DetectionStatus
{
  kOk,              ///< At least one reliable pose.
  kNoPickablePose,  ///< Points, but no reliable pose.
  kRoiEmpty,        ///< No measured point inside the region of interest.
  kTimeLimit,       ///< The time limit ended the search; the poses are those found until then.
  kBadCloud,        ///< The cloud cannot be worked on; the message says why.
};

/// A vote peak of one reference point.
struct PoseHypothesis
{
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();  ///< Of T_cloud_model.
  Eigen::Vector3f center =
      Eigen::Vector3f::Zero();  ///< The part's centre in the cloud's frame [m].
  float votes = 0;              ///< Weighted votes, in units of one full vote.
  std::uint32_t model = 0;      ///< Index of the model in the call.
  std::int32_t cluster = -1;    ///< Index into clusters of the result; -1: noise.
};

/// A box that fits a set of points along their principal axes.
struct OrientedBox
{
  Eigen::Isometry3d T_cloud_box =
      Eigen::Isometry3d::Identity();               ///< Centre and axes (right-handed) [m].
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< Side lengths, longest first [m].
};

/// A cluster of hypotheses.
struct HypothesisCluster
{
  std::uint32_t model = 0;
  OrientedBox box;  ///< Of the centres.
  std::size_t hypotheses = 0;
  bool mismatching = false;  ///< The box's sides add up to more than max_spread_rel diameters.
};

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// -1 in the first entry, else 0.
inline Matrix6d unknownCovariance()
{
  Matrix6d unknown = Matrix6d::Zero();
  unknown(0, 0) = -1;
  return unknown;
}

/// A pose with what the cloud says of it.
struct DetectedPose
{
  std::uint32_t model = 0;  ///< Index of the model in the call.
  Eigen::Isometry3d T_cloud_model =
      Eigen::Isometry3d::Identity();  ///< The mesh's frame in the cloud's [m].
  double score = 0;  ///< Share of the surface it expects that the cloud confirms; see poseScore().
  double votes = 0;  ///< Summed votes of the pose's group of hypotheses.
  double visible_fraction =
      0;  ///< Of the surface a free part would show, the share not hidden by others.
  double rms_error_m = 0;  ///< Of the confirmed points, along their normals [m].
  double support = 0;    ///< Share of the pixels not hidden that are confirmed, unweighted. [0, 1]
  int confirmed_px = 0;  ///< Pixels of the working image that confirm it.
  double slide_share =
      0;  ///< Of the outline that would stop the worst slide, the broken share. [0, 1]
  double hold =
      0;  ///< How firmly surfaces and edges hold the worst motion; see pose_information.hpp.
  double spread = 0;            ///< Sum of the sides of its hypotheses' box, in diameters.
  double margin = 1;            ///< Lead over the best rival, relative to its pixels. At most 1.
  double evidence_balance = 0;  ///< For it less against it, per pixel that confirms it. At most 1.
  double looked_through =
      0;  ///< Of the surface it expects, the share the cloud lies behind. [0, 1]
  double usual_looked_through = 0;  ///< What its part's other poses show; see setUsualShares().
  /// Of its edges in sight, its outline or where something hides it, the share where the cloud
  /// neither ends nor steps. [0, 1]
  double outline_broken = 0;
  double pierced = 0;        ///< Of the same edges, the share the cloud passes through. [0, 1]
  double usual_pierced = 0;  ///< What its part's other poses show; see setUsualShares().
  double goes_on = 0;        ///< ... beyond which a surface goes on that is no held pose's. [0, 1]
  double claimed = 0;        ///< Of the surface it expects, the share better poses explain. [0, 1]
  double reliability = 0;    ///< Probability that it is right; see reliability.hpp. [0, 1]
  /// What lowers the reliability most, of a pose that stands in the result.
  ReliabilityTerm main_doubt = ReliabilityTerm::kScore;
  /// Of x y z rx ry rz [m, rad]: shifts of the mesh's origin and turns about it, along the cloud
  /// frame's axes; -1 in its first entry while unknown. See pose_covariance.hpp.
  Matrix6d covariance = unknownCovariance();
  bool reliable = false;
  UnreliableReason reason = UnreliableReason::kNone;  ///< kNone if and only if reliable.
  std::int32_t cluster = -1;  ///< The cluster it came from; -1 under greedy clustering.
};

/// Where poses cannot be told apart, or why one was turned down; drawn in red.
struct MismatchingRegion
{
  std::uint32_t model = 0;
  UnreliableReason reason = UnreliableReason::kSpread;
  OrientedBox box;  ///< Spread: of the hypotheses' centres; otherwise of the part at best_pose.
  Eigen::Isometry3d T_cloud_best =
      Eigen::Isometry3d::Identity();  ///< Its best pose, T_cloud_model [m].
  double score = 0;                   ///< Of the best pose, as of a DetectedPose.
  double reliability = 0;             ///< The same.
  std::size_t hypotheses = 0;
  std::string detail;  ///< One sentence with the figures.
};

/// Seconds of one stage.
struct StageTime
{
  std::string name;
  double seconds = 0;
};

struct DetectionResult
{
  DetectionStatus status = DetectionStatus::kNoPickablePose;
  std::string message;                     ///< One sentence a person can act on.
  std::vector<DetectedPose> poses;         ///< As sortResult() puts them.
  std::vector<MismatchingRegion> regions;  ///< Best score first.
  std::vector<PoseHypothesis>
      distribution;  ///< The probable pose distribution: all high-vote hypotheses.
  std::vector<HypothesisCluster> clusters;
  std::vector<Eigen::Vector3f> scene_points;  ///< The sampled scene of the first model [m].
  std::size_t roi_points = 0;                 ///< Measured points in the region of interest.
  double noise_m = 0;                         ///< Of the depth in the region; see depthNoise().
  std::vector<StageTime> stages;              ///< In order of execution.
  double seconds = 0;                         ///< Whole detection.
};
}  // namespace ppf_bin_picking

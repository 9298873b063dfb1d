/// @file Which of the poses found in one scene are right.
#pragma once

#include "ppf_bin_picking/core/detection_result.hpp"
#include "ppf_bin_picking/core/pose_errors.hpp"

#include <Eigen/Geometry>

#include <limits>
#include <vector>

namespace ppf_bin_picking
{
/// A pose as a result file holds it.
struct ScoredPose
{
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();
  double score = 0;
  bool reliable = false;
  Matrix6d covariance = unknownCovariance();  ///< As DetectedPose has it.
};

/// An object of the scene.
struct TrueObject
{
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();
  double visibility = 0;  ///< Share of its surface that the camera could see. In [0, 1].
};

/// When a pose is right, and which objects are to be found.
struct JudgementRules
{
  double threshold_rel = 0.1;   ///< MSSD below this share of the diameter is right. > 0.
  double min_visibility = 0.5;  ///< Objects at least so visible are the targets.
};

enum class Verdict
{
  kRight,      ///< The first pose on a target.
  kWrong,      ///< On no object.
  kDuplicate,  ///< On an object that a pose of a higher score took.
  kIgnored,    ///< The first pose on an object that is no target: counts neither way.
};

/// `right`, `wrong`, `duplicate`, `ignored`.
const char* toString(Verdict verdict);

/// What became of one pose. Object and errors are those of the object of the lowest MSSD; the
/// object is -1, and the errors are infinite, where the pose is no rigid transformation.
struct JudgedPose
{
  std::size_t index = 0;  ///< In the result's list.
  double score = 0;
  bool reliable = false;
  Verdict verdict = Verdict::kWrong;
  int object = -1;
  double mssd_rel = PoseErrors::kAnyDistance;  ///< MSSD over the diameter.
  double translation_m = PoseErrors::kAnyDistance;
  double rotation_rad = PoseErrors::kAnyDistance;
  /// Normalised estimation error squared: the error's square in units of the pose's covariance. NaN
  /// where that is unknown. Its mean is the number of degrees of freedom where covariances are
  /// honest (Bar-Shalom, Li and Kirubarajan 2001, Estimation with Applications to Tracking and
  /// Navigation, section 5.4): 6, for a revolution 5.
  double nees = std::numeric_limits<double>::quiet_NaN();
};

/// True for finite numbers whose linear part has the determinant 1 (to 1e-3).
bool isRigid(const Eigen::Isometry3d& pose);

/// Indices of the poses, highest score first; equal scores in the given order.
std::vector<std::size_t> byScore(const std::vector<ScoredPose>& poses);

/// True if the object is one that is to be found.
bool isTarget(const TrueObject& object, const JudgementRules& rules);

/// Judges poses in the order of their scores. Each belongs to the object of the lowest MSSD (Hodan
/// et al. 2020, section 2), and each object can be found once; objects less visible than the
/// targets count neither way (Bregier et al., Symmetry Aware Evaluation of 3D Object Detection and
/// Pose Estimation in Scenes of Many Parts in Bulk, ICCV workshops 2017).
/// @return One entry a pose, best score first.
std::vector<JudgedPose> judgePoses(const std::vector<ScoredPose>& poses,
                                   const std::vector<TrueObject>& objects, const PoseErrors& errors,
                                   const JudgementRules& rules);
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/evidence_climb.hpp"
#include "ppf_bin_picking/core/pose_refinement.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr float kRadius_m = 0.01F;
constexpr float kLength_m = 0.06F;

/// A rod with a head, lying before a wall.
class RodClimb : public ::testing::Test
{
protected:
  static TriangleMesh rodMesh()
  {
    return joined({cylinderMesh(kRadius_m, kLength_m, 64),
                   shifted(cylinderMesh(1.5F * kRadius_m, 0.008F, 64), {0, 0, 0.034F})});
  }

  Climb climbFrom(const Eigen::Isometry3d& start) const
  {
    return climbEvidence(image_, model_, start.cast<float>(), evidenceAt(start), config_);
  }

  PoseEvidence evidenceAt(const Eigen::Isometry3d& pose) const
  {
    return gatherEvidence(image_, model_, pose.cast<float>(), config_);
  }

  static double balance(const PoseEvidence& evidence)
  {
    return evidenceBalance(evidence, evidence.confirmed_weight);
  }

  /// How far a pose lies beside the true one in the image, about [m].
  double besides(const Eigen::Isometry3d& pose) const
  {
    const Eigen::Vector3d center = model_.data().center.cast<double>();
    const Eigen::Vector3d shift = pose * center - true_pose_ * center;
    return std::abs(shift.dot(across_));
  }

  const Eigen::Vector3d across_ = Eigen::Vector3d::UnitY();
  const Eigen::Isometry3d true_pose_ = poseOf(M_PI / 2, {0, 1, 0}, {0, 0, 0.55});  // along x
  const PpfModel model_ = coarselyTrained(rodMesh());
  RangeImage image_ = imageOf({wall(0.565), {rodMesh(), true_pose_}}, 0.004F, 0.0001F);
  DetectorConfig config_;
};

TEST_F(RodClimb, staysToTheBitWhereThePoseFits)
{
  const Climb climb = climbFrom(true_pose_);
  EXPECT_EQ(climb.T_camera_model.matrix(), true_pose_.cast<float>().matrix());
  EXPECT_EQ(climb.evidence.confirmed.size(), evidenceAt(true_pose_).confirmed.size());
}

TEST_F(RodClimb, comesBackFromBesideAndFromATurn)
{
  for (const double shift_m : {-0.0015, 0.0015})
  {
    const Eigen::Isometry3d start = Eigen::Translation3d(shift_m * across_) * true_pose_;
    const Climb climb = climbFrom(start);
    EXPECT_LT(besides(climb.T_camera_model.cast<double>()), 0.5 * std::abs(shift_m));
    EXPECT_GT(balance(climb.evidence), balance(evidenceAt(start)));
  }
  for (const double angle_rad : {-0.06, 0.06})
  {
    const Eigen::Vector3d center = true_pose_ * model_.data().center.cast<double>();
    const Eigen::Isometry3d start = Eigen::Translation3d(center) *
                                    Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()) *
                                    Eigen::Translation3d(-center) * true_pose_;
    const Eigen::Isometry3d end = climbFrom(start).T_camera_model.cast<double>();
    const double left_rad = std::acos((end.linear().col(2)).dot(true_pose_.linear().col(2)));
    EXPECT_LT(left_rad, 0.5 * std::abs(angle_rad));
  }
}

TEST_F(RodClimb, evidenceIsThatOfThePoseReturned)
{
  const Climb climb = climbFrom(Eigen::Translation3d(0.0015 * across_) * true_pose_);
  const PoseEvidence anew = gatherEvidence(image_, model_, climb.T_camera_model, config_);
  EXPECT_EQ(climb.evidence.confirmed_weight, anew.confirmed_weight);
  EXPECT_EQ(climb.evidence.outline_broken, anew.outline_broken);
}

TEST_F(RodClimb, undoesWhatATiltedStripOfAShinySurfaceDoesToTheRefinement)
{
  // The middle of the rod alone is measured, tilted about its axis; the wall shows beside it.
  const RangeImage bare = imageOf({wall(0.565)}, 0.004F, 0.0001F);
  for (int v = 0; v < image_.camera.height; ++v)
    for (int u = 0; u < image_.camera.width; ++u)
    {
      const std::size_t index = image_.index(u, v);
      const float z = image_.depth[index];
      const float y_m = z * (static_cast<float>(v) - image_.camera.cy) / image_.camera.fy;
      if (z > 0.563F) continue;
      image_.depth[index] = std::abs(y_m) < 0.75F * kRadius_m ? z + 0.2F * y_m : bare.depth[index];
    }
  estimateImageNormals(image_, 2, 0.004F, 1);
  const Eigen::Isometry3d refined =
      refinePose(image_, model_, true_pose_.cast<float>(), config_).cast<double>();
  const Climb climb = climbFrom(refined);
  RecordProperty("refined_um", static_cast<int>(1e6 * besides(refined)));
  RecordProperty("climbed_um",
                 static_cast<int>(1e6 * besides(climb.T_camera_model.cast<double>())));
  EXPECT_GT(besides(refined), 0.0008) << "the strip draws the part aside";
  EXPECT_LT(besides(climb.T_camera_model.cast<double>()), 0.5 * besides(refined));
}

TEST_F(RodClimb, survivesAPoseThatSeesNothing)
{
  const Eigen::Isometry3d aside = Eigen::Translation3d(5, 0, 0) * true_pose_;
  const Climb climb = climbFrom(aside);
  EXPECT_EQ(climb.T_camera_model.matrix(), aside.cast<float>().matrix());
  EXPECT_TRUE(climb.evidence.confirmed.empty());
}
}  // namespace
}  // namespace ppf_bin_picking

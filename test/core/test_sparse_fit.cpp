#include "ppf_bin_picking/core/normals.hpp"
#include "ppf_bin_picking/core/sparse_fit.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// A bracket before a wall.
class SparseFitTest : public ::testing::Test
{
protected:
  SparseFitTest()
  {
    image_.camera = smallCamera();
    const PlacedMesh wall{squareMesh(1.0F), poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6})};
    image_.depth = renderDepth({{bracketMesh(), true_pose_}, wall}, image_.camera);
    image_.in_roi.assign(image_.depth.size(), 1);
    estimateImageNormals(image_, 2, 0.004F, 1);
  }

  SparseFit fitFrom(const Eigen::Isometry3d& start) const
  {
    return fitSparsely(image_, model_, start.cast<float>(), config_);
  }

  Eigen::Vector3d centerAt(const Eigen::Isometry3d& pose) const
  {
    return pose * model_.data().center.cast<double>();
  }

  const Eigen::Isometry3d true_pose_ =
      poseOf(0.9, {0, 0, 1}, {0, 0, 0.5}) * poseOf(2.4, {0.8, 0.6, 0}, {0, 0, 0});
  const PpfModel model_ = PpfModel::train(bracketMesh(), SymmetryGroup(), ModelParameters());
  RangeImage image_;
  DetectorConfig config_;
};

TEST_F(SparseFitTest, confirmsTheTruePoseAndLeavesItWhereItIs)
{
  const SparseFit fit = fitFrom(true_pose_);
  EXPECT_GT(fit.balance, 0.5F);
  EXPECT_LT((centerAt(fit.T_camera_model.cast<double>()) - centerAt(true_pose_)).norm(),
            0.01 * model_.diameter());
  EXPECT_LT(angleBetween(fit.T_camera_model.cast<double>(), true_pose_), 0.03);
}

TEST_F(SparseFitTest, bringsADisturbedPoseNearer)
{
  const Eigen::Vector3d shift_m = 0.05 * model_.diameter() * Eigen::Vector3d(0.3, -0.3, 0.9);
  const Eigen::Isometry3d start = Eigen::Translation3d(shift_m) * true_pose_;
  const SparseFit fit = fitFrom(start);
  EXPECT_LT((centerAt(fit.T_camera_model.cast<double>()) - centerAt(true_pose_)).norm(),
            0.5 * shift_m.norm());
  EXPECT_GT(fit.balance, 0.3F);
}

TEST_F(SparseFitTest, findsPosesBeforeTheSurfaceLookedThrough)
{
  const Eigen::Isometry3d before = Eigen::Translation3d(0, 0, -0.2) * true_pose_;
  EXPECT_LT(fitFrom(before).balance, -1.5F);
}

TEST_F(SparseFitTest, findsNothingAgainstAHiddenPose)
{
  const Eigen::Isometry3d behind = Eigen::Translation3d(0, 0, 0.3) * true_pose_;
  EXPECT_NEAR(fitFrom(behind).balance, 0.0F, 0.1F);
}

TEST_F(SparseFitTest, confirmsNothingOutsideTheRegion)
{
  image_.in_roi.assign(image_.depth.size(), 0);
  EXPECT_LE(fitFrom(true_pose_).balance, 0.0F);
}

TEST_F(SparseFitTest, aPoseBesideTheImageHasNoBalance)
{
  const Eigen::Isometry3d beside = Eigen::Translation3d(5, 0, 0) * true_pose_;
  EXPECT_EQ(fitFrom(beside).balance, 0.0F);
}
}  // namespace
}  // namespace ppf_bin_picking

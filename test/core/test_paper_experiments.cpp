// The experiments of the method's paper: parts without a definite pose, and one with.
#include "ppf_bin_picking/core/detector.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kNoise_m = 0.0002F;

/// Coarse, so that a plane full of votes takes a second; every scene point is a reference point.
DetectorConfig experimentConfig()
{
  DetectorConfig config;
  config.model.step_rel = 0.1;
  config.reference_share = 1.0;
  return config;
}

TEST(SphereOnSphere, positionsGatherWhileOrientationsFillTheBall)
{
  const DetectorConfig config = experimentConfig();
  const SymmetryGroup sphere({}, {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()},
                                  {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}});
  const PpfModel model = PpfModel::train(sphereMesh(0.04F), sphere, config.model);
  const Eigen::Vector3d truth(0.01, -0.02, 0.6);
  const PointCloud cloud =
      renderCloud({{sphereMesh(0.04F), poseOf(0, {0, 0, 1}, truth)}}, smallCamera(), kNoise_m);
  const DetectionResult result = Detector(config).detect(cloud, model);

  ASSERT_GT(result.distribution.size(), 100U);
  const double count = static_cast<double>(result.distribution.size());
  std::size_t gathered = 0;
  std::array<std::size_t, 8> octants{};
  std::array<std::size_t, 4> shells{};  // of equal thickness
  for (const PoseHypothesis& hypothesis : result.distribution)
  {
    if ((hypothesis.center.cast<double>() - truth).norm() < 0.1 * model.diameter()) ++gathered;
    const Eigen::AngleAxisf turn(hypothesis.rotation);
    const Eigen::Vector3f p = turn.angle() / static_cast<float>(M_PI) * turn.axis();
    ++octants[(p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U) + (p.z() > 0 ? 4U : 0U)];
    ++shells[std::min<std::size_t>(3, static_cast<std::size_t>(4 * p.norm()))];
  }
  EXPECT_GE(static_cast<double>(gathered), 0.9 * count);
  for (const std::size_t octant : octants)
    EXPECT_GE(static_cast<double>(octant), 0.05 * count);
  for (const std::size_t shell : shells)
    EXPECT_GE(static_cast<double>(shell), 0.01 * count);

  ASSERT_EQ(result.status, DetectionStatus::kOk);
  const Eigen::Vector3d center =
      result.poses.front().T_cloud_model * model.data().center.cast<double>();
  EXPECT_LT((center - truth).norm(), 0.02 * model.diameter());
}

class CubeOnPlane : public ::testing::Test
{
protected:
  DetectionResult detect(const DetectorConfig& config) const
  {
    const PinholeCamera camera{400, 360, 600, 600, 199.5F, 179.5F};
    return Detector(config).detect(
        renderCloud({{squareMesh(0.13F), T_camera_plane_}}, camera, kNoise_m), model_);
  }

  PpfModel model_ =
      PpfModel::train(boxMesh({0.05F, 0.05F, 0.05F}), SymmetryGroup(), experimentConfig().model);
  Eigen::Isometry3d T_camera_plane_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6}) * poseOf(0.25, {0, 1, 0}, {0, 0, 0});
};

TEST_F(CubeOnPlane, slidesOverThePlaneFaceToFace)
{
  const DetectionResult result = detect(experimentConfig());
  ASSERT_GT(result.distribution.size(), 500U);
  Eigen::AlignedBox3d extent;  // of the centres, plane's frame
  std::size_t face_to_face = 0;
  for (const PoseHypothesis& hypothesis : result.distribution)
  {
    extent.extend(T_camera_plane_.inverse() * hypothesis.center.cast<double>());
    const Eigen::Vector3d normal_model = hypothesis.rotation.conjugate().cast<double>() *
                                         Eigen::Vector3d(T_camera_plane_.linear().col(2));
    if (normal_model.cwiseAbs().maxCoeff() > std::cos(0.1)) ++face_to_face;
  }
  const Eigen::Vector3d spread_rel = extent.sizes() / model_.diameter();
  EXPECT_GT(spread_rel.x(), 1.0);
  EXPECT_GT(spread_rel.y(), 1.0);
  EXPECT_LT(spread_rel.z(), 0.15);
  EXPECT_GE(static_cast<double>(face_to_face),
            0.95 * static_cast<double>(result.distribution.size()));
}

TEST_F(CubeOnPlane, isFlaggedAsMismatchingRegion)
{
  const DetectionResult result = detect(experimentConfig());
  EXPECT_EQ(result.status, DetectionStatus::kNoPickablePose);
  EXPECT_TRUE(std::any_of(result.clusters.begin(), result.clusters.end(),
                          [](const HypothesisCluster& cluster) { return cluster.mismatching; }));
  ASSERT_FALSE(result.regions.empty());
  for (const MismatchingRegion& region : result.regions)
  {
    EXPECT_TRUE(region.reason == UnreliableReason::kSpread ||
                region.reason == UnreliableReason::kSlippage);
    EXPECT_FALSE(region.detail.empty());
  }
}

TEST_F(CubeOnPlane, hasNoReliablePoseWithFewReferencePointsEither)
{
  DetectorConfig config = experimentConfig();
  config.reference_share = DetectorConfig().reference_share;
  const DetectionResult result = detect(config);
  EXPECT_EQ(result.status, DetectionStatus::kNoPickablePose);
  ASSERT_FALSE(result.regions.empty());
  for (const MismatchingRegion& region : result.regions)
    EXPECT_TRUE(region.reason == UnreliableReason::kSpread ||
                region.reason == UnreliableReason::kSlippage);
}

TEST_F(CubeOnPlane, isBelievedOnlyWithoutTheMismatchTest)
{
  DetectorConfig config = experimentConfig();
  config.reference_share = DetectorConfig().reference_share;
  config.mismatch_test = false;
  const DetectionResult result = detect(config);
  EXPECT_EQ(result.status, DetectionStatus::kOk);
  for (const MismatchingRegion& region : result.regions)
    EXPECT_EQ(region.reason, UnreliableReason::kLowScore);
}

/// A bracket, turned by the parameter [rad], on a table that fills the view.
class BracketOnPlane : public ::testing::TestWithParam<double>
{
protected:
  BracketOnPlane() { config_.model.step_rel = 0.1; }

  PointCloud cloud() const
  {
    return renderCloud({{squareMesh(0.5F), T_camera_table_}, {bracketMesh(), truth_}},
                       smallCamera(), kNoise_m);
  }
  void expectRight(const Eigen::Isometry3d& T_camera_model) const
  {
    EXPECT_LT((T_camera_model.translation() - truth_.translation()).norm(),
              0.02 * model_.diameter());
    EXPECT_LT(angleBetween(T_camera_model, truth_), 2 * M_PI / 180);
  }

  DetectorConfig config_;
  PpfModel model_ = PpfModel::train(bracketMesh(), SymmetryGroup(), experimentConfig().model);
  Eigen::Isometry3d T_camera_table_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.62}) * poseOf(0.3, {1, 0, 0}, {0, 0, 0});
  Eigen::Isometry3d truth_ = T_camera_table_ * poseOf(GetParam(), {0, 0, 1}, {0.01, 0.02, 0});
};

TEST_P(BracketOnPlane, isFoundAndNotFlaggedWhateverTheClustering)
{
  const RegionOfInterest above_table{T_camera_table_, {-0.12, -0.12, 0.004}, {0.12, 0.12, 0.1}};
  std::vector<Eigen::Isometry3d> best;
  for (const Clustering clustering : {Clustering::kDbscan, Clustering::kGreedy})
  {
    SCOPED_TRACE(toString(clustering));
    config_.clustering = clustering;
    const DetectionResult result = Detector(config_).detect(cloud(), model_, above_table);
    ASSERT_EQ(result.status, DetectionStatus::kOk);
    EXPECT_TRUE(result.regions.empty());
    ASSERT_EQ(result.poses.size(), 1U);
    EXPECT_TRUE(result.poses.front().reliable);
    expectRight(result.poses.front().T_cloud_model);
    best.push_back(result.poses.front().T_cloud_model);
  }
  EXPECT_LT((best[0].translation() - best[1].translation()).norm(), 0.002 * model_.diameter());
  EXPECT_LT(angleBetween(best[0], best[1]), 0.2 * M_PI / 180);
}

TEST_P(BracketOnPlane, isTheOnlyReliablePoseWithTheTableInTheRegion)
{
  for (const bool climb : {true, false})
  {
    config_.climb = climb;
    const DetectionResult result = Detector(config_).detect(cloud(), model_);
    ASSERT_EQ(result.status, DetectionStatus::kOk);
    EXPECT_EQ(std::count_if(result.poses.begin(), result.poses.end(),
                            [](const DetectedPose& pose) { return pose.reliable; }),
              1);
    expectRight(result.poses.front().T_cloud_model);
    for (const MismatchingRegion& region : result.regions)
      EXPECT_GT((region.T_cloud_best.translation() - truth_.translation()).norm(),
                0.3 * model_.diameter());
    EXPECT_EQ(std::any_of(result.stages.begin(), result.stages.end(),
                          [](const StageTime& stage) { return stage.name == "climbing"; }),
              climb);
  }
}

INSTANTIATE_TEST_SUITE_P(Turns, BracketOnPlane, ::testing::Values(0.5, 2.0, 4.0));
}  // namespace
}  // namespace ppf_bin_picking

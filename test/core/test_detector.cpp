#include "ppf_bin_picking/core/detector.hpp"
#include "ppf_bin_picking/core/reliability.hpp"

#include "support/bracket_and_angle.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
class DetectorTest : public BracketAndAngle
{
protected:
  /// True if the pose is the bracket's within 0.02 diameters and 2 degrees.
  bool isBracket(const DetectedPose& pose) const
  {
    return (pose.T_cloud_model.translation() - T_camera_bracket_.translation()).norm() <
               0.02 * bracket_.diameter() &&
           angleBetween(pose.T_cloud_model, T_camera_bracket_) < 2 * M_PI / 180;
  }

  PpfModel angle_ = PpfModel::train(angleMesh(), SymmetryGroup(), coarseConfig().model);
};

void expectSamePoses(const DetectionResult& a, const DetectionResult& b)
{
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i)
  {
    EXPECT_TRUE(a.poses[i].T_cloud_model.matrix() == b.poses[i].T_cloud_model.matrix());
    EXPECT_EQ(a.poses[i].score, b.poses[i].score);
    EXPECT_EQ(a.poses[i].votes, b.poses[i].votes);
    EXPECT_EQ(a.poses[i].slide_share, b.poses[i].slide_share);
    EXPECT_EQ(a.poses[i].reason, b.poses[i].reason);
  }
  ASSERT_EQ(a.distribution.size(), b.distribution.size());
  for (std::size_t i = 0; i < a.distribution.size(); ++i)
  {
    EXPECT_TRUE(a.distribution[i].center == b.distribution[i].center);
    EXPECT_TRUE(a.distribution[i].rotation.coeffs() == b.distribution[i].rotation.coeffs());
    EXPECT_EQ(a.distribution[i].cluster, b.distribution[i].cluster);
  }
  EXPECT_EQ(a.regions.size(), b.regions.size());
}

TEST_F(DetectorTest, givesTheSameBytesForAnyNumberOfThreads)
{
  DetectorConfig config = coarseConfig();
  config.threads = 1;
  const PointCloud seen = cloud();
  const std::vector<const PpfModel*> models{&bracket_, &angle_};
  const DetectionResult one = Detector(config).detect(seen, models);
  ASSERT_GT(one.poses.size(), 2U);
  for (const int threads : {2, 4})
  {
    SCOPED_TRACE(threads);
    config.threads = threads;
    expectSamePoses(one, Detector(config).detect(seen, models));
  }
}

TEST_F(DetectorTest, explainsTheRightPoseAsItsBest)
{
  const PoseExplanation right =
      Detector(coarseConfig()).explain(cloud(), bracket_, roi_, T_camera_bracket_);
  expectSamePoses(right.result, detect(coarseConfig()));
  EXPECT_EQ(right.fate, PoseFate::kReliable);
  EXPECT_EQ(right.rank, 0);
  EXPECT_EQ(right.owner, 0);
  EXPECT_GT(right.owned_share, 0.9);
  EXPECT_GT(right.surface.hypotheses, 0U);
  EXPECT_GT(right.boundary.hypotheses, 0U);
  EXPECT_GE(right.surface.best_votes,
            right.surface.votes / static_cast<double>(right.surface.hypotheses));
  EXPECT_GT(right.candidates, 0U);
  EXPECT_GT(right.score, 0.9);
  EXPECT_LT(right.refined_shift_m, 0.02 * bracket_.diameter());
}

TEST_F(DetectorTest, followsATurnOfTheSceneAboutTheLineOfSight)
{
  for (const double turn_rad : {0.4, M_PI / 2, 3.0})
  {
    SCOPED_TRACE(turn_rad);
    const Eigen::Isometry3d T_turned = poseOf(turn_rad, {0, 0, 1}, {0, 0, 0});
    RegionOfInterest roi = roi_;
    roi.T_cloud_box = T_turned * roi_.T_cloud_box;
    const DetectionResult result = Detector(coarseConfig()).detect(cloud(turn_rad), bracket_, roi);
    ASSERT_EQ(result.status, DetectionStatus::kOk);
    DetectedPose turned_back = result.poses.front();
    turned_back.T_cloud_model = T_turned.inverse() * turned_back.T_cloud_model;
    EXPECT_TRUE(isBracket(turned_back));
  }
}

TEST_F(DetectorTest, findsThePoseInPointsWithoutOrder)
{
  const DetectionResult result =
      Detector(coarseConfig()).detect(shuffledCloud(cloud()), bracket_, roi_);
  ASSERT_EQ(result.status, DetectionStatus::kOk);
  EXPECT_TRUE(isBracket(result.poses.front()));
}

TEST_F(DetectorTest, findsEachOfTwoPartsOnce)
{
  const DetectionResult result =
      Detector(coarseConfig()).detect(cloud(), {&bracket_, &angle_}, roi_);
  ASSERT_EQ(result.status, DetectionStatus::kOk);
  std::vector<int> found(2, 0);
  for (const DetectedPose& pose : result.poses)
    if (pose.reliable) ++found.at(pose.model);
  EXPECT_EQ(found, std::vector<int>({1, 1}));
  for (const DetectedPose& pose : result.poses)
  {
    if (!pose.reliable) continue;
    const Eigen::Isometry3d& truth = pose.model == 0 ? T_camera_bracket_ : T_camera_angle_;
    const double diameter_m = pose.model == 0 ? bracket_.diameter() : angle_.diameter();
    EXPECT_LT((pose.T_cloud_model.translation() - truth.translation()).norm(), 0.02 * diameter_m);
    EXPECT_LT(angleBetween(pose.T_cloud_model, truth), 2 * M_PI / 180);
  }
}

TEST_F(DetectorTest, findsThePartInThePapersMode)
{
  DetectorConfig config = coarseConfig();
  config.poses_per_cluster = 1;
  const DetectionResult result = detect(config);
  ASSERT_EQ(result.status, DetectionStatus::kOk);
  EXPECT_TRUE(isBracket(result.poses.front()));
  EXPECT_LE(result.poses.size(), result.clusters.size());
}

TEST_F(DetectorTest, leavesThePoseAloneWithoutTheMismatchTest)
{
  DetectorConfig config = coarseConfig();
  config.mismatch_test = false;
  const DetectionResult result = detect(config);
  ASSERT_EQ(result.status, DetectionStatus::kOk);
  EXPECT_TRUE(isBracket(result.poses.front()));
}

TEST_F(DetectorTest, endsAtTheTimeLimitWithoutWrongPoses)
{
  DetectorConfig config = coarseConfig();
  for (const double limit_s : {1e-6, 2e-3, 1e-2, 2e-2, 4e-2})
  {
    SCOPED_TRACE(limit_s);
    config.time_limit_s = limit_s;
    const DetectionResult result = detect(config);
    if (limit_s == 1e-6)
    {
      EXPECT_EQ(result.status, DetectionStatus::kTimeLimit);
      EXPECT_NE(result.message.find("time_limit_s"), std::string::npos) << result.message;
    }
    for (const DetectedPose& pose : result.poses)
      EXPECT_TRUE(!pose.reliable || isBracket(pose));
  }
}

TEST_F(DetectorTest, endsWhenToldToStop)
{
  const std::atomic<bool> stop = true;
  const DetectionResult result = Detector(coarseConfig()).detect(cloud(), bracket_, roi_, &stop);
  EXPECT_EQ(result.status, DetectionStatus::kTimeLimit);
  EXPECT_TRUE(result.poses.empty());
}

TEST_F(DetectorTest, judgesAPoseByWhetherThereIsARegion)
{
  for (const bool whole_cloud : {false, true})
  {
    SCOPED_TRACE(whole_cloud);
    const auto roi = whole_cloud ? std::nullopt : std::optional<RegionOfInterest>(roi_);
    const DetectionResult result = Detector(coarseConfig()).detect(cloud(), bracket_, roi);
    ASSERT_FALSE(result.poses.empty());
    for (const DetectedPose& pose : result.poses)
    {
      EXPECT_EQ(pose.reliability, assessReliability(pose, whole_cloud).probability);
      EXPECT_EQ(pose.main_doubt, assessReliability(pose, whole_cloud).main_doubt);
      EXPECT_NE(pose.reliability, assessReliability(pose, !whole_cloud).probability);
    }
  }
}

TEST_F(DetectorTest, strayPointsChangeNothing)
{
  const RegionOfInterest tall{T_camera_table_, {-0.14, -0.1, 0.004}, {0.14, 0.1, 0.7}};
  const auto findIn = [&](const PointCloud& seen)
  {
    const DetectionResult result = Detector(coarseConfig()).detect(seen, bracket_, tall);
    return !result.poses.empty() && result.poses[0].reliable && isBracket(result.poses[0]);
  };
  ASSERT_TRUE(findIn(cloud()));
  ASSERT_TRUE(findIn(shuffledCloud(cloud())));
  const std::size_t middle = 120 * 320 + 160;
  for (const float z : {1e-30F, 0.05F, 0.2F})
  {
    SCOPED_TRACE(z);
    PointCloud seen = cloud();
    seen.points[middle] *= z / seen.points[middle].z();
    EXPECT_TRUE(findIn(seen));
    EXPECT_TRUE(findIn(shuffledCloud(seen)));
  }
  PointCloud sideways = shuffledCloud(cloud());
  sideways.points.emplace_back(1e30F, 0.0F, 1e-30F);
  sideways.points.emplace_back(1e30F, 1e30F, 1.0F);
  ++ ++sideways.width;
  EXPECT_TRUE(findIn(sideways));
}
}  // namespace
}  // namespace ppf_bin_picking

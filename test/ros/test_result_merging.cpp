#include "ppf_bin_picking/ros/result_merging.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking_ros
{
namespace
{
using ppf_bin_picking::DetectedPose;
using ppf_bin_picking::DetectionResult;
using ppf_bin_picking::DetectionStatus;
using ppf_bin_picking::PpfModel;
using ppf_bin_picking::UnreliableReason;

/// Away from a place 0.8 m before the camera.
Eigen::Isometry3d at(const double x_m, const double y_m = 0, const double z_m = 0)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, y_m, 0.8 + z_m));
}

class Merging : public testing::Test
{
protected:
  /// A detection of one model with reliable poses (x [m], score).
  static DetectionResult found(const std::uint32_t model,
                               const std::vector<std::pair<double, double>>& poses)
  {
    DetectionResult result;
    result.status = poses.empty() ? DetectionStatus::kNoPickablePose : DetectionStatus::kOk;
    result.message = "of one detection";
    result.seconds = 0.5;
    result.stages = {{"voting", 0.5}};
    for (const auto& [x_m, score] : poses)
    {
      DetectedPose pose;
      pose.model = model;
      pose.T_cloud_model = at(x_m);
      pose.score = score;
      pose.reliability = 0.95;
      pose.reliable = true;
      pose.cluster = static_cast<std::int32_t>(result.clusters.size());
      result.poses.push_back(pose);
      result.clusters.emplace_back().hypotheses = 7;
      result.distribution.emplace_back().cluster = pose.cluster;
    }
    return result;
  }

  DetectionResult merge(std::vector<DetectionResult> results) const
  {
    return merged(std::move(results), {&box_, &same_box_, &plate_});
  }

  static std::vector<std::pair<std::uint32_t, double>> reliable(const DetectionResult& result)
  {
    std::vector<std::pair<std::uint32_t, double>> list;
    for (const DetectedPose& pose : result.poses)
      if (pose.reliable) list.emplace_back(pose.model, pose.score);
    return list;
  }
  using List = std::vector<std::pair<std::uint32_t, double>>;

  static PpfModel trained(const Eigen::Vector3f& size_m)
  {
    return PpfModel::train(ppf_bin_picking::boxMesh(size_m), ppf_bin_picking::SymmetryGroup(), {});
  }

  static inline const PpfModel box_ = trained({0.06F, 0.04F, 0.03F});
  static inline const PpfModel same_box_ = trained({0.06F, 0.04F, 0.03F});
  static inline const PpfModel plate_ = trained({0.06F, 0.04F, 0.004F});
  static inline const PpfModel small_ = trained({0.012F, 0.01F, 0.005F});
};

TEST_F(Merging, sharedSurfaceIsAllOrNothingWhereThatIsTrue)
{
  EXPECT_EQ(sharedSurface(box_, at(0.2), same_box_, at(0.2)), 1);
  EXPECT_EQ(sharedSurface(plate_, at(0, 0, 0.013), box_, at(0)), 0);  // hidden inside
  EXPECT_GT(sharedSurface(plate_, at(0, 0, -0.013), box_, at(0)),
            0.95);  // with the same upper face
  EXPECT_EQ(sharedSurface(box_, at(0), same_box_, at(1)), 0);
  EXPECT_EQ(sharedSurface(box_, at(0), small_, at(0.012, 0.004, -0.0125)), 1);
  EXPECT_EQ(sharedSurface(small_, at(0.012, 0.004, -0.0125), box_, at(0)), 1);
}

TEST_F(Merging, partsThatTouchShareNothing)
{
  // Side by side, end to end, one before the other, a plate before a plate and before a box.
  EXPECT_LT(sharedSurface(box_, at(0), same_box_, at(0, 0.04)), 0.05);
  EXPECT_LT(sharedSurface(box_, at(0), same_box_, at(0.06)), 0.05);
  EXPECT_LT(sharedSurface(box_, at(0), same_box_, at(0.059)), 0.05);
  EXPECT_EQ(sharedSurface(box_, at(0), same_box_, at(0, 0, 0.03)), 0);
  EXPECT_EQ(sharedSurface(plate_, at(0), plate_, at(0, 0, 0.004)), 0);
  EXPECT_LT(sharedSurface(box_, at(0), small_, at(0, 0, -0.0175)), 0.05);
}

TEST_F(Merging, partsHalfInOnePlaceShareHalf)
{
  EXPECT_NEAR(sharedSurface(plate_, at(0), plate_, at(0.03)), 0.5, 0.03);
  EXPECT_NEAR(sharedSurface(plate_, at(0), plate_, at(0, 0.01)), 0.75, 0.03);
  EXPECT_NEAR(sharedSurface(plate_, at(0, 0.01), plate_, at(0)), 0.75, 0.03);
}

TEST_F(Merging, onlyTheBetterOfTwoInOnePlaceStaysReliable)
{
  const DetectionResult all =
      merge({found(0, {{0.0, 0.8}, {0.2, 0.6}}), found(1, {{0.001, 0.7}, {0.199, 0.9}})});
  EXPECT_EQ(reliable(all), (List{{1, 0.9}, {0, 0.8}}));
  ASSERT_EQ(all.poses.size(), 4U);
  EXPECT_EQ(all.status, DetectionStatus::kOk);
  EXPECT_EQ(all.message, "2 reliable poses");
  ASSERT_EQ(all.regions.size(), 2U);
  EXPECT_EQ(all.regions[0].score, 0.7);
  EXPECT_EQ(all.regions[1].score, 0.6);
  const auto& region = all.regions[0];
  EXPECT_EQ(region.reason, UnreliableReason::kOverlap);
  EXPECT_EQ(region.model, 1U);
  EXPECT_EQ(region.hypotheses, 7U);
  EXPECT_EQ(region.reliability, 0.95);
  EXPECT_NEAR(region.T_cloud_best.translation().x(), 0.001, 1e-9);
  EXPECT_NEAR((region.box.T_cloud_box.translation() - at(0.001).translation()).norm(), 0, 1e-6);
  EXPECT_NEAR((region.box.size - Eigen::Vector3d(0.06, 0.04, 0.03)).norm(), 0, 1e-6);
  EXPECT_NE(region.detail.find(" %"), std::string::npos);
  for (std::size_t i = 2; i < 4; ++i)
    EXPECT_EQ(all.poses[i].reason, UnreliableReason::kOverlap);
}

TEST_F(Merging, whatHasFallenTurnsDownNobody)
{
  // The second falls to the first, so that the third, in the second's place alone, stands.
  const DetectionResult all =
      merge({found(0, {{0.0, 0.9}}), found(1, {{0.035, 0.8}}), found(2, {{0.07, 0.7}})});
  EXPECT_EQ(reliable(all), (List{{0, 0.9}, {2, 0.7}}));
}

TEST_F(Merging, posesOfOneDetectionAreLeftToIt)
{
  EXPECT_EQ(reliable(merge({found(0, {{0.0, 0.9}, {0.001, 0.8}}), found(1, {})})),
            (List{{0, 0.9}, {0, 0.8}}));
}

TEST_F(Merging, unreliablePosesTurnDownNobody)
{
  DetectionResult sliding = found(0, {{0.0, 0.9}});
  sliding.poses[0].reliable = false;
  sliding.poses[0].reason = UnreliableReason::kSlippage;
  const DetectionResult all = merge({sliding, found(1, {{0.0, 0.7}})});
  EXPECT_EQ(reliable(all), (List{{1, 0.7}}));
  EXPECT_EQ(all.poses[1].reason, UnreliableReason::kSlippage);
}

TEST_F(Merging, clustersStayThoseOfTheirPoses)
{
  const DetectionResult all = merge({found(0, {{0.0, 0.8}, {0.2, 0.6}}), found(1, {{0.4, 0.7}})});
  ASSERT_EQ(all.clusters.size(), 3U);
  EXPECT_EQ(all.poses[1].score, 0.7);
  EXPECT_EQ(all.poses[1].cluster, 2);
  EXPECT_EQ(all.distribution[2].cluster, 2);
  EXPECT_EQ(all.seconds, 1.0);
  EXPECT_EQ(all.stages.size(), 2U);
}

TEST_F(Merging, statusAndMessageAreThoseOfTheWhole)
{
  EXPECT_EQ(merge({found(0, {}), found(1, {{0.0, 0.7}})}).message, "1 reliable pose");
  EXPECT_EQ(merge({found(0, {}), found(1, {})}).status, DetectionStatus::kNoPickablePose);
  EXPECT_NE(merge({found(0, {}), found(1, {})}).message.find("nothing like the part was found"),
            std::string::npos);
  DetectionResult poor = found(0, {{0.0, 0.3}});
  poor.poses[0].reliable = false;
  const DetectionResult none = merge({found(1, {}), poor});
  EXPECT_EQ(none.status, DetectionStatus::kNoPickablePose);
  EXPECT_NE(none.message.find("no reliable pose among 1 found"), std::string::npos);

  DetectionResult cut = found(1, {{0.0, 0.7}});
  cut.status = DetectionStatus::kTimeLimit;
  const DetectionResult late = merge({found(0, {{0.2, 0.8}}), cut});
  EXPECT_EQ(late.status, DetectionStatus::kTimeLimit);
  EXPECT_NE(late.message.find("with 2 reliable poses"), std::string::npos) << late.message;

  DetectionResult empty;
  empty.status = DetectionStatus::kRoiEmpty;
  empty.message = "no measured point";
  EXPECT_EQ(merge({empty, empty}).status, DetectionStatus::kRoiEmpty);
  EXPECT_EQ(merge({empty, empty}).message, "no measured point");
  EXPECT_EQ(merge({found(0, {{0.0, 0.7}})}).message, "of one detection");
}
}  // namespace
}  // namespace ppf_bin_picking_ros

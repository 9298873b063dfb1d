#include "ppf_bin_picking/core/verification.hpp"

#include "support/plate_before_wall.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>

namespace ppf_bin_picking
{
namespace
{
class VerificationTest : public PlateBeforeWall
{
protected:
  double scoreIn(const RangeImage& image) const
  {
    const PoseEvidence evidence = evidenceIn(image);
    return poseScore(evidence, evidence.confirmed_weight);
  }

  /// Changes the pixels of the part in one half of it.
  void changeHalf(RangeImage& image, const std::function<void(std::size_t)>& change) const
  {
    for (int v = 0; v < image.camera.height; ++v)
      for (int u = 0; u < middle_px_; ++u)
        if (image.depth[image.index(u, v)] < 0.7F) change(image.index(u, v));
  }

  double gate_m() const { return config_.depth_gate_rel * plate_.diameter(); }

  const int middle_px_ = 160;
};

TEST_F(VerificationTest, aPerfectSceneScoresOne)
{
  const PoseEvidence evidence = evidenceIn(freeImage());
  ASSERT_GT(evidence.confirmed.size(), 4000U);
  EXPECT_DOUBLE_EQ(poseScore(evidence, evidence.confirmed_weight), 1.0);
  EXPECT_DOUBLE_EQ(evidence.support(), 1.0);
  EXPECT_DOUBLE_EQ(visibleFraction(evidence), 1.0);
  EXPECT_DOUBLE_EQ(evidence.expected(), evidence.confirmed_weight);
  EXPECT_EQ(evidence.outline_broken, 0);
  EXPECT_GT(evidence.outline_held, 200);
  EXPECT_TRUE(evidence.goes_on.empty());
  EXPECT_LT(evidence.rms_error_m, 1e-6);
  const double sum = std::accumulate(evidence.confirmed.begin(), evidence.confirmed.end(), 0.0,
                                     [](double total, const PoseEvidence::Pixel& pixel)
                                     { return total + pixel.weight; });
  EXPECT_NEAR(sum, evidence.confirmed_weight, 1e-6 * sum);
}

TEST_F(VerificationTest, theConfirmedPixelsAreThoseOfThePart)
{
  const PoseEvidence evidence = evidenceIn(freeImage());
  const RangeImage alone = perfectImage({{mesh_, T_camera_plate_}});
  std::size_t covered = 0;
  for (const float z : alone.depth)
    covered += z > 0 ? 1 : 0;
  EXPECT_EQ(evidence.confirmed.size(), covered);
  for (const PoseEvidence::Pixel& pixel : evidence.confirmed)
    EXPECT_GT(alone.depth[pixel.index], 0);
}

TEST_F(VerificationTest, coveringHalfLeavesTheScore)
{
  RangeImage image = freeImage();
  const double whole = evidenceIn(image).confirmed_weight;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < middle_px_; ++u)
    {
      image.depth[image.index(u, v)] = 0.4F;
      image.normals[image.index(u, v)] = {0, 0, -1};
    }
  const PoseEvidence evidence = evidenceIn(image);
  EXPECT_DOUBLE_EQ(poseScore(evidence, evidence.confirmed_weight), 1.0);
  EXPECT_DOUBLE_EQ(evidence.support(), 1.0);
  EXPECT_NEAR(evidence.occluded, whole / 2, 0.03 * whole);
  EXPECT_NEAR(visibleFraction(evidence), 0.5, 0.03);
  EXPECT_EQ(evidence.outline_broken, 0);
}

TEST_F(VerificationTest, aCloudBehindTheSurfaceContradicts)
{
  RangeImage image = freeImage();
  const double whole = evidenceIn(image).confirmed_weight;
  changeHalf(image,
             [&](std::size_t i)
             {
               image.depth[i] = 0.8F;
               image.normals[i] = {0, 0, -1};
             });
  const PoseEvidence evidence = evidenceIn(image);
  EXPECT_NEAR(evidence.confirmed_weight, whole / 2, 0.03 * whole);
  EXPECT_GT(evidence.looked_through, 0.8 * whole / 2);
  EXPECT_LE(evidence.looked_through, whole / 2 + 0.03 * whole);
  EXPECT_GT(evidence.outline_broken, 80) << "absent along that half";
  EXPECT_LT(poseScore(evidence, evidence.confirmed_weight), 0.5);
  EXPECT_NEAR(evidence.support(), 0.5, 0.03);
}

TEST_F(VerificationTest, missingPixelsWeighLessThanContradictions)
{
  RangeImage looked_through = freeImage(), missing = freeImage();
  changeHalf(looked_through, [&](std::size_t i) { looked_through.depth[i] = 0.8F; });
  changeHalf(missing, [&](std::size_t i) { missing.depth[i] = 0; });
  const PoseEvidence evidence = evidenceIn(missing);
  EXPECT_GT(evidence.missing, 0.4 * evidence.expected());
  EXPECT_EQ(evidence.looked_through, 0);
  EXPECT_LT(scoreIn(missing), 0.8);
  EXPECT_GT(scoreIn(missing), scoreIn(looked_through) + 0.2);
  EXPECT_EQ(scoreIn(perfectImage({})), 0);
}

TEST_F(VerificationTest, aSurfaceWithAnotherNormalContradictsAndAnUnknownOneConfirms)
{
  RangeImage turned = freeImage(), nearly = freeImage(), unknown = freeImage();
  const auto turn = [&](RangeImage& image, double angle_rad)
  {
    const Eigen::Matrix3f rotation =
        Eigen::AngleAxisf(static_cast<float>(angle_rad), Eigen::Vector3f::UnitX())
            .toRotationMatrix();
    changeHalf(image, [&](std::size_t i) { image.normals[i] = rotation * image.normals[i]; });
  };
  turn(turned, config_.normal_gate_rad + 0.05);
  turn(nearly, config_.normal_gate_rad - 0.05);
  changeHalf(unknown, [&](std::size_t i) { unknown.normals[i].setZero(); });
  const PoseEvidence evidence = evidenceIn(turned);
  EXPECT_GT(evidence.wrong_normal, 0.4 * evidence.expected());
  EXPECT_LT(scoreIn(turned), 0.6);
  EXPECT_DOUBLE_EQ(scoreIn(nearly), 1.0);
  EXPECT_DOUBLE_EQ(scoreIn(unknown), 1.0);
}

TEST_F(VerificationTest, whatLiesOutsideTheRegionConfirmsNothing)
{
  RangeImage half = freeImage(), none = freeImage();
  changeHalf(half, [&](std::size_t i) { half.in_roi[i] = 0; });
  none.in_roi.assign(none.in_roi.size(), 0);
  EXPECT_NEAR(scoreIn(half), 0.5, 0.03);
  const PoseEvidence evidence = evidenceIn(none);
  EXPECT_TRUE(evidence.confirmed.empty());
  EXPECT_GT(evidence.outside, 4000);
  EXPECT_EQ(poseScore(evidence, evidence.confirmed_weight), 0);
}

TEST_F(VerificationTest, theDepthGateDecidesAlongTheNormal)
{
  const RangeImage image = freeImage();
  const Eigen::Vector3d normal = T_camera_plate_.linear().col(2);  // towards the camera
  const auto moved = [&](double gates)
  {
    Eigen::Isometry3d pose = T_camera_plate_;
    pose.translation() += gates * gate_m() * normal;
    return gatherEvidence(image, plate_, pose.cast<float>(), config_);
  };
  for (const double gates : {-0.9, -0.4, 0.4, 0.9})
  {
    SCOPED_TRACE(gates);
    const PoseEvidence evidence = moved(gates);
    EXPECT_GT(evidence.support(), 0.95);
    EXPECT_NEAR(evidence.rms_error_m, std::abs(gates) * gate_m(), 0.03 * gate_m());
  }
  EXPECT_GT(moved(1.2).looked_through, 3000) << "too near to the camera";
  EXPECT_LT(moved(1.2).confirmed.size(), 200U);
  EXPECT_GT(moved(-1.2).occluded, 3000) << "within what is measured";
  EXPECT_LT(moved(-1.2).confirmed.size(), 200U);
}

TEST_F(VerificationTest, surfacesFlatToTheLineOfSightNeedNotBeSeen)
{
  const Eigen::Isometry3d T_camera_edge_on =
      poseOf(0, {1, 0, 0}, {0, 0, 0.6}) * poseOf(1.45, {1, 0, 0}, {0, 0, 0});
  const TriangleMesh square = squareMesh(0.05F);
  const PpfModel sheet = coarselyTrained(square);
  const PoseEvidence evidence =
      gatherEvidence(perfectImage({wall(0.8)}), sheet, T_camera_edge_on.cast<float>(), config_);
  EXPECT_GT(evidence.visible_px, 500);
  EXPECT_EQ(evidence.expected(), 0);
}

TEST_F(VerificationTest, aSheetIsConfirmedFromEitherSide)
{
  const TriangleMesh square = squareMesh(0.04F);
  const PpfModel sheet = coarselyTrained(square);
  for (const double turn_rad : {0.0, M_PI})
  {
    const Eigen::Isometry3d T_camera_sheet = poseOf(turn_rad, {1, 0, 0}, {0, 0, 0.6});
    const PoseEvidence evidence =
        gatherEvidence(perfectImage({wall(0.8), {square, T_camera_sheet}}), sheet,
                       T_camera_sheet.cast<float>(), config_);
    EXPECT_GT(evidence.confirmed.size(), 5000U);
    EXPECT_DOUBLE_EQ(poseScore(evidence, evidence.confirmed_weight), 1.0);
  }
}

TEST_F(VerificationTest, aPartOutsideTheImageHasNoEvidence)
{
  const Eigen::Isometry3f beside = poseOf(0, {1, 0, 0}, {2, 0, 0.6}).cast<float>();
  const PoseEvidence evidence = gatherEvidence(freeImage(), plate_, beside, config_);
  EXPECT_EQ(evidence.visible_px, 0);
  EXPECT_EQ(poseScore(evidence, 0), 0);
  EXPECT_EQ(visibleFraction(evidence), 0);
  EXPECT_EQ(evidence.support(), 0);
}

/// Evidence with some of everything.
PoseEvidence mixedEvidence()
{
  PoseEvidence evidence;
  evidence.confirmed_weight = 100;
  evidence.looked_through = 10;
  evidence.wrong_normal = 10;
  evidence.missing = 10;
  evidence.occluded = 10;
  evidence.outside = 10;
  evidence.outline_held = 10;
  evidence.outline_broken = 10;
  return evidence;
}

TEST(EvidenceBalance, risesWithWhatSpeaksForThePoseAndFallsWithWhatSpeaksAgainst)
{
  const auto balance = [](double PoseEvidence::*field, double by)
  {
    PoseEvidence evidence = mixedEvidence();
    evidence.*field += by;
    return evidenceBalance(evidence, 80);
  };
  const double before = evidenceBalance(mixedEvidence(), 80);
  EXPECT_GT(balance(&PoseEvidence::outline_held, 1), before);
  for (const auto field : {&PoseEvidence::looked_through, &PoseEvidence::wrong_normal,
                           &PoseEvidence::missing, &PoseEvidence::occluded, &PoseEvidence::outside,
                           &PoseEvidence::outline_broken, &PoseEvidence::pierced})
    EXPECT_LT(balance(field, 1), before);
  // A pixel that a better pose claims is one less for it and one against it.
  EXPECT_DOUBLE_EQ(evidenceBalance(mixedEvidence(), 81) - before, 2);
  // A contradiction weighs more than a missing pixel, that more than a hidden one.
  EXPECT_LT(balance(&PoseEvidence::looked_through, 1), balance(&PoseEvidence::missing, 1));
  EXPECT_LT(balance(&PoseEvidence::missing, 1), balance(&PoseEvidence::occluded, 1));
}

TEST(EvidenceBalance, growsWithTheSurfaceExplainedWhereTheScoreDoesNot)
{
  PoseEvidence small, large;
  small.confirmed_weight = 100;
  large.confirmed_weight = 400;
  EXPECT_EQ(poseScore(small, 100), poseScore(large, 400));
  EXPECT_GT(evidenceBalance(large, 400), evidenceBalance(small, 100));
  PoseEvidence contradicted = small;
  contradicted.looked_through = 100;
  EXPECT_LT(evidenceBalance(contradicted, 100), 0);
}

TEST(PoseScore, fallsWithContradictionsAloneAndStaysAShare)
{
  const double before = poseScore(mixedEvidence(), 80);
  EXPECT_GT(before, 0);
  EXPECT_LT(before, 1);
  for (const auto field :
       {&PoseEvidence::looked_through, &PoseEvidence::wrong_normal, &PoseEvidence::missing,
        &PoseEvidence::outside, &PoseEvidence::outline_broken, &PoseEvidence::pierced})
  {
    PoseEvidence evidence = mixedEvidence();
    evidence.*field += 1;
    EXPECT_LT(poseScore(evidence, 80), before);
  }
  PoseEvidence hidden = mixedEvidence();
  hidden.occluded += 1000;
  EXPECT_DOUBLE_EQ(poseScore(hidden, 80), before);
  EXPECT_LT(visibleFraction(hidden), visibleFraction(mixedEvidence()));
  EXPECT_GT(poseScore(mixedEvidence(), 90), before);
  EXPECT_EQ(poseScore(mixedEvidence(), 0), 0);
  PoseEvidence contested;  // nothing against it but the pixels that a better pose claims
  contested.confirmed_weight = 100;
  EXPECT_DOUBLE_EQ(poseScore(contested, 80), 0.8);
}
}  // namespace
}  // namespace ppf_bin_picking

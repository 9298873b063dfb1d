#include "ppf_bin_picking/core/ambiguity.hpp"
#include "ppf_bin_picking/core/verification.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// What a perfect sensor sees of a scene: depths and the surfaces' own normals; all in the region.
RangeImage perfectImage(const std::vector<PlacedMesh>& scene)
{
  RangeImage image;
  image.camera = smallCamera();
  const std::size_t pixels = static_cast<std::size_t>(image.camera.width) * image.camera.height;
  image.depth.assign(pixels, 0);
  image.normals.assign(pixels, Eigen::Vector3f::Zero());
  image.in_roi.assign(pixels, 1);
  RenderedPart view;
  for (const PlacedMesh& placed : scene)
  {
    renderPart(RenderableMesh(placed.mesh), placed.T_camera_mesh.cast<float>(), image.camera, view);
    for (int row = 0; row < view.height; ++row)
      for (int column = 0; column < view.width; ++column)
      {
        const float z = view.depthAt(column, row);
        const std::size_t i = image.index(view.left + column, view.top + row);
        if (z == 0 || (image.depth[i] > 0 && image.depth[i] <= z)) continue;
        image.depth[i] = z;
        const Eigen::Vector3f& normal =
            view.normals[view.triangle[static_cast<std::size_t>(row) * view.width + column]];
        const bool away = normal.dot(image.point(view.left + column, view.top + row)) > 0;
        image.normals[i] = away ? Eigen::Vector3f(-normal) : normal;
      }
  }
  return image;
}

/// A plate of 80 x 60 x 6 mm that looks at the camera, slanted a little, far before a wall.
class VerificationTest : public ::testing::Test
{
protected:
  RangeImage freeImage() const { return perfectImage({wall(0.8), {mesh_, T_camera_plate_}}); }

  PoseEvidence evidenceIn(const RangeImage& image) const
  {
    return gatherEvidence(image, plate_, T_camera_plate_.cast<float>(), config_);
  }

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

  DetectorConfig config_;
  const int middle_px_ = 160;
  const TriangleMesh mesh_ = boxMesh({0.08F, 0.06F, 0.006F});
  const PpfModel plate_ = coarselyTrained(mesh_);
  const Eigen::Isometry3d T_camera_plate_ =
      poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6}) * poseOf(0.1, {1, 2, 0}, {0, 0, 0});
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

TEST_F(VerificationTest, aPlateOnALargerPlaneSlidesAndAFreeOneDoesNot)
{
  const auto slide_share = [&](const RangeImage& image)
  {
    Candidate candidate;
    candidate.T_camera_model = T_camera_plate_.cast<float>();
    candidate.evidence = evidenceIn(image);
    const SelectedPose selected{0, candidate.evidence.confirmed_weight, 0};
    return assessAmbiguity({&plate_}, config_, {candidate}, {selected}, image.depth.size())[0]
        .slide_share;
  };
  // Its upper face lies in a plane that is larger.
  const RangeImage flush =
      perfectImage({{shifted(squareMesh(0.2F), {0, 0, 0.003F}), T_camera_plate_}});
  const PoseEvidence evidence = evidenceIn(flush);
  EXPECT_DOUBLE_EQ(evidence.support(), 1.0) << "it fits perfectly";
  EXPECT_EQ(evidence.outline_held, 0);
  EXPECT_GT(evidence.goes_on.size(), 200U);
  EXPECT_DOUBLE_EQ(slide_share(flush), 1.0);
  EXPECT_DOUBLE_EQ(slide_share(freeImage()), 0.0);

  // A strip as wide as the plate, along x: it slides along the strip alone.
  TriangleMesh strip = shifted(squareMesh(0.2F), {0, 0, 0.003F});
  for (Eigen::Vector3f& vertex : strip.vertices)
    vertex.y() *= 0.03F / 0.2F;
  const PoseEvidence on_strip = evidenceIn(perfectImage({wall(0.8), {strip, T_camera_plate_}}));
  EXPECT_GT(on_strip.outline_held, 120);
  EXPECT_GT(on_strip.goes_on.size(), 80U);
  for (const PoseEvidence::Continuation& continuation : on_strip.goes_on)
  {
    EXPECT_GT(std::abs(continuation.direction.x()), 0.5F);
    const int u = static_cast<int>(continuation.pixel % 320U);
    EXPECT_GT(std::abs(static_cast<float>(u) - 159.5F), 38.0F) << "beyond the plate's end";
    EXPECT_EQ(continuation.direction.x() > 0, u > 160);
  }
}

TEST_F(VerificationTest, whereThePartIsAbsentItsOutlineStopsNoSlide)
{
  const PoseEvidence evidence = evidenceIn(perfectImage({wall(0.8)}));
  EXPECT_GT(evidence.outline_broken, 200);
  EXPECT_EQ(evidence.outline_held, 0);
  EXPECT_TRUE(evidence.goes_on.empty());
  EXPECT_EQ(*std::max_element(evidence.slide_held.begin(), evidence.slide_held.end()), 0);
  EXPECT_GT(*std::min_element(evidence.slide_broken.begin(), evidence.slide_broken.end()), 10);
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

TEST(AddSlideStop, weighsBothWaysAcrossAlike)
{
  SlideStops right{}, left{}, diagonal{};
  addSlideStop({1, 0}, right);
  addSlideStop({-1, 0}, left);
  addSlideStop(Eigen::Vector2f(1, 1).normalized(), diagonal);
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    EXPECT_NEAR(right[i], std::pow(std::cos(M_PI * static_cast<double>(i) / 8), 4), 1e-6);
    EXPECT_NEAR(left[i], right[i], 1e-6);
    EXPECT_NEAR(diagonal[(i + 2) % 8], right[i], 1e-6) << "the same, turned";
  }
}
}  // namespace
}  // namespace ppf_bin_picking

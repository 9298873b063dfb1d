#include "ppf_bin_picking/core/ambiguity.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kPixels = 1000;

/// Poses of one part by hand: candidate k confirms the pixels it is told to.
class AmbiguityTest : public ::testing::Test
{
protected:
  /// Adds a candidate at a distance of `place_m` along x.
  Candidate& add(double place_m, std::uint32_t first_pixel, std::uint32_t pixels)
  {
    Candidate candidate;
    candidate.T_camera_model = poseOf(0, {0, 0, 1}, {place_m, 0, 0.5}).cast<float>();
    candidate.verified = true;
    for (std::uint32_t i = 0; i < pixels; ++i)
      candidate.evidence.confirmed.push_back({first_pixel + i, 1.0F});
    candidate.evidence.confirmed_weight = pixels;
    candidates_.push_back(candidate);
    return candidates_.back();
  }

  /// Lets a candidate stand with all its pixels.
  void stand(std::size_t candidate)
  {
    const PoseEvidence& evidence = candidates_[candidate].evidence;
    selected_.push_back({candidate, evidence.confirmed_weight,
                         evidenceBalance(evidence, evidence.confirmed_weight)});
  }

  std::vector<Ambiguity> assess() const
  {
    return assessAmbiguity({&model_}, config_, candidates_, selected_, kPixels);
  }

  /// An outline to the right beyond which the surface goes on at a pixel.
  static void openTowards(Candidate& candidate, std::uint32_t pixel)
  {
    candidate.evidence.goes_on.push_back({pixel, Eigen::Vector2f(1, 0)});
  }

  DetectorConfig config_;
  PpfModel model_ = PpfModel::train(boxMesh({0.05F, 0.04F, 0.03F}), SymmetryGroup(),
                                    []
                                    {
                                      ModelParameters coarse;
                                      coarse.step_rel = 0.2;
                                      return coarse;
                                    }());
  std::vector<Candidate> candidates_;
  std::vector<SelectedPose> selected_;
};

TEST_F(AmbiguityTest, aPoseSlidesWhereItsSurfaceGoesOnUnowned)
{
  openTowards(add(0, 0, 100), 500);
  stand(0);
  EXPECT_DOUBLE_EQ(assess()[0].slide_share, 1.0);
  EXPECT_EQ(assess()[0].goes_on_px, 1);
}

TEST_F(AmbiguityTest, trustSpreadsAlongAChainOfPosesThatTouch)
{
  openTowards(add(0.0, 0, 100), 150);  // onto the next
  openTowards(add(0.1, 100, 100), 250);
  addSlideStop({1, 0}, add(0.2, 200, 100).evidence.slide_held);  // ends freely
  for (const std::size_t i : {0, 1, 2})
    stand(i);
  for (const Ambiguity& ambiguity : assess())
  {
    EXPECT_DOUBLE_EQ(ambiguity.slide_share, 0.0);
    EXPECT_EQ(ambiguity.goes_on_px, 0) << "the surface beyond is a neighbour's";
  }
}

TEST_F(AmbiguityTest, isTheSameInWhateverOrderThePosesWereTaken)
{
  Candidate& first = add(0.0, 0, 100);  // held as it is, and touches the next
  openTowards(first, 150);
  addSlideStop({1, 0}, first.evidence.slide_held);
  addSlideStop({1, 0}, add(0.1, 100, 100).evidence.slide_held);
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 0}})
  {
    selected_.clear();
    stand(a);
    stand(b);
    const Ambiguity touching = assess()[a == 0 ? 0 : 1];
    EXPECT_EQ(touching.goes_on_px, 0) << a;
    EXPECT_DOUBLE_EQ(touching.slide_share, 0.0) << a;
  }
}

TEST_F(AmbiguityTest, posesThatOnlyHoldEachOtherAreNotHeld)
{
  openTowards(add(0.0, 0, 100), 150);
  openTowards(add(0.1, 100, 100), 50);
  stand(0);
  stand(1);
  for (const Ambiguity& ambiguity : assess())
  {
    EXPECT_DOUBLE_EQ(ambiguity.slide_share, 1.0);
    EXPECT_EQ(ambiguity.goes_on_px, 1);
  }
}

TEST_F(AmbiguityTest, theWorstDirectionCounts)
{
  Candidate& candidate = add(0, 0, 100);
  for (int i = 0; i < 9; ++i)
    addSlideStop({0, 1}, candidate.evidence.slide_held);
  openTowards(candidate, 500);
  addSlideStop({1, 0}, candidate.evidence.slide_held);
  stand(0);
  EXPECT_NEAR(assess()[0].slide_share, 0.5, 1e-6);
}

TEST_F(AmbiguityTest, theMarginIsTheLeadOverTheBestRivalPerPixel)
{
  add(0, 0, 100);
  add(0.03, 0, 70);   // claims 70 of its pixels
  add(0.03, 10, 60);  // fewer
  stand(0);
  EXPECT_NEAR(assess()[0].margin, 0.3, 1e-9);
}

TEST_F(AmbiguityTest, whatAPoseGainedByClimbingIsNoLead)
{
  add(0, 0, 100);
  add(0.03, 0, 70);
  stand(0);
  candidates_[0].climbed = 20;
  EXPECT_NEAR(assess()[0].margin, 0.1, 1e-9);
}

TEST_F(AmbiguityTest, whatIsHiddenOrMissingOfARivalIsNoLead)
{
  add(0, 0, 100);
  add(0.03, 0, 95);  // explains the pixels as well, whatever else it expects
  stand(0);
  candidates_[1].evidence.occluded = 500;
  EXPECT_NEAR(assess()[0].margin, 0.05, 1e-9);
  candidates_[1].evidence.missing = 300;
  EXPECT_NEAR(assess()[0].margin, 0.05, 1e-9);
  candidates_[1].evidence.looked_through = 10;
  EXPECT_GT(assess()[0].margin, 0.3);
}

TEST_F(AmbiguityTest, aPoseIsNotItsOwnRival)
{
  add(0, 0, 100);
  add(0.001, 0, 99);  // the same pose within group_distance_rel
  stand(0);
  EXPECT_DOUBLE_EQ(assess()[0].margin, 1.0);
}

TEST_F(AmbiguityTest, aCandidateThatClaimsLessThanHalfIsNoRival)
{
  add(0, 0, 100);
  add(0.03, 51, 100);
  stand(0);
  EXPECT_DOUBLE_EQ(assess()[0].margin, 1.0);
}

TEST_F(AmbiguityTest, whatThirdPosesOwnDoesNotCountForARival)
{
  add(0, 0, 100);
  add(0.1, 100, 100);
  add(0.03, 40, 100);  // 60 of the first, 40 of the second
  stand(0);
  stand(1);
  // Its 40 contested pixels are neither confirmed nor free: 60 - 40.
  EXPECT_NEAR(assess()[0].margin, 0.8, 1e-9);
  EXPECT_DOUBLE_EQ(assess()[1].margin, 1.0);
}

TEST_F(AmbiguityTest, aRivalWithMoreEvidenceMakesTheMarginNegative)
{
  add(0, 0, 100);
  add(0.03, 0, 150);
  stand(0);
  EXPECT_NEAR(assess()[0].margin, -0.5, 1e-9);
}

TEST_F(AmbiguityTest, aCandidateLeftUnverifiedWithinADiameterMayBeARival)
{
  add(0, 0, 100);
  add(0.2, 100, 100);
  add(0.03, 0, 0).verified = false;
  stand(0);
  stand(1);
  EXPECT_FALSE(assess()[0].rivals_known);
  EXPECT_TRUE(assess()[1].rivals_known);
}
}  // namespace
}  // namespace ppf_bin_picking

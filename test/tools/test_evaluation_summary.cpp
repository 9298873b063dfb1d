#include "evaluation_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
constexpr Verdict kRight = Verdict::kRight;
constexpr Verdict kWrong = Verdict::kWrong;
constexpr Verdict kDuplicate = Verdict::kDuplicate;
constexpr Verdict kIgnored = Verdict::kIgnored;

JudgedPose judged(double score, Verdict verdict, bool reliable = true)
{
  JudgedPose pose;
  pose.score = score;
  pose.verdict = verdict;
  pose.reliable = reliable;
  pose.translation_m = 0.001 * score;
  pose.rotation_rad = M_PI / 180 * score;
  pose.nees = score;
  return pose;
}

double areaOf(const std::vector<JudgedPose>& poses, std::size_t targets)
{
  return averagePrecision(precisionRecall(poses, targets));
}

TEST(AveragePrecision, ofHandMadeLists)
{
  EXPECT_EQ(areaOf({}, 5), 0);
  EXPECT_EQ(areaOf({judged(1, kRight)}, 1), 1);
  EXPECT_EQ(areaOf({judged(1, kRight)}, 4), 0.25);
  EXPECT_EQ(areaOf({judged(1, kWrong)}, 4), 0);
  EXPECT_EQ(areaOf({judged(1, kWrong), judged(0.5, kRight)}, 2), 0.25);
  EXPECT_EQ(areaOf({judged(0.5, kRight), judged(1, kWrong)}, 2), 0.25);  // order of scores
  EXPECT_EQ(areaOf({judged(1, kRight), judged(0.5, kWrong)}, 2), 0.5);
  EXPECT_EQ(areaOf({judged(1, kRight), judged(0.5, kDuplicate)}, 1), 1);
  EXPECT_EQ(areaOf({judged(1, kDuplicate), judged(0.5, kRight)}, 1), 0.5);
  EXPECT_EQ(areaOf({judged(1, kIgnored), judged(0.5, kRight)}, 1), 1);
  EXPECT_EQ(areaOf({judged(1, kWrong), judged(0.5, kRight)}, 0), 0);
}

TEST(AveragePrecision, takesTheBestPrecisionAtAHigherRecall)
{
  // Precisions 1, 1/2, 2/3, 3/4 at recalls 1/4, 1/4, 2/4, 3/4: 1 and 3/4 count, the latter twice.
  const std::vector<JudgedPose> poses = {judged(0.9, kRight), judged(0.8, kWrong),
                                         judged(0.7, kRight), judged(0.6, kRight)};
  EXPECT_NEAR(areaOf(poses, 4), 0.25 * (1 + 0.75 + 0.75), 1e-15);
}

TEST(AveragePrecision, takesEqualScoresInTheGivenOrder)
{
  EXPECT_EQ(areaOf({judged(0.5, kWrong), judged(0.5, kRight)}, 1), 0.5);
  EXPECT_EQ(areaOf({judged(0.5, kRight), judged(0.5, kWrong)}, 1), 1);
}

TEST(PrecisionRecall, hasAPointAPoseThatCounts)
{
  const auto curve = precisionRecall(
      {judged(0.7, kWrong), judged(0.9, kRight), judged(0.8, kIgnored), judged(0.6, kRight)}, 4);
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_EQ(curve[0].score, 0.9);
  EXPECT_EQ(curve[1].score, 0.7);
  EXPECT_EQ(curve[1].precision, 0.5);
  EXPECT_EQ(curve[1].recall, 0.25);
  EXPECT_NEAR(curve[2].precision, 2.0 / 3, 1e-15);
  EXPECT_EQ(curve[2].recall, 0.5);
}

/// Two scenes with everything that can happen, and one without a result.
std::vector<JudgedScene> handMadeScenes()
{
  JudgedScene a;
  a.targets = 4;
  a.time_ms = 30;
  a.recalled = {2, 1.5, 1};
  a.poses = {judged(9, kWrong, false), judged(8, kIgnored),      judged(7, kRight),
             judged(6, kDuplicate),    judged(5, kRight, false), judged(4, kDuplicate, false)};
  JudgedScene b;
  b.targets = 2;
  b.time_ms = 10;
  b.recalled = {1, 0.5, 1};
  b.poses = {judged(6.5, kWrong), judged(3, kRight), judged(2, kWrong, false)};
  JudgedScene c;
  c.targets = 4;
  return {a, b, c};
}

TEST(Summary, countsWhatWasFound)
{
  const Summary s = summarise(handMadeScenes());
  EXPECT_EQ(s.scenes, 3U);
  EXPECT_EQ(s.targets, 10U);
  EXPECT_EQ(s.right, 2U);
  EXPECT_EQ(s.wrong, 2U);  // a duplicate among them
  EXPECT_EQ(s.precision, 0.5);
  EXPECT_EQ(s.recall, 0.2);
  EXPECT_NEAR(s.first, 1.0 / 3, 1e-15);        // ignored is on an object
  EXPECT_EQ(s.flag_precision, 0.5);            // two of four are wrong, one is a duplicate
  EXPECT_NEAR(s.flag_recall, 2.0 / 3, 1e-15);  // duplicates left aside
  EXPECT_NEAR(s.lost, 1.0 / 3, 1e-15);
  EXPECT_NEAR(s.translation_mm, 5, 1e-12);  // of 7 and 3
  EXPECT_NEAR(s.rotation_deg, 5, 1e-12);
  EXPECT_EQ(s.nees, 5);
  EXPECT_EQ(s.median_ms, 20);
  EXPECT_EQ(s.largest_ms, 30);
  EXPECT_NEAR(s.recall_vsd, 0.3, 1e-15);
  EXPECT_NEAR(s.recall_mssd, 0.2, 1e-15);
  EXPECT_NEAR(s.recall_mspd, 0.2, 1e-15);
}

TEST(Summary, drawsCurvesOverAllScenes)
{
  const Summary s = summarise(handMadeScenes());
  // Right at ranks 2, 5 and 7 of all that count: wrong 9, right 7, wrong 6.5, duplicate 6, right 5,
  // duplicate 4, right 3, wrong 2. Of the reliable: right 7, wrong 6.5, duplicate 6, right 3.
  ASSERT_EQ(s.curve.size(), 8U);
  EXPECT_NEAR(s.average_precision, 0.1 * (1.0 / 2 + 3.0 / 7 + 3.0 / 7), 1e-15);
  EXPECT_NEAR(s.average_precision_reliable, 0.1 * (1 + 2.0 / 4), 1e-15);
}

TEST(Summary, ofNothingHasNoShares)
{
  const Summary s = summarise({JudgedScene()});
  EXPECT_EQ(s.average_precision, 0);
  EXPECT_EQ(s.first, 0);
  for (const double none :
       {s.precision, s.recall, s.flag_precision, s.flag_recall, s.lost, s.translation_mm,
        s.rotation_deg, s.median_ms, s.largest_ms, s.recall_vsd})
    EXPECT_TRUE(std::isnan(none));
  EXPECT_TRUE(std::isnan(summarise({}).first));
}
}  // namespace
}  // namespace ppf_bin_picking

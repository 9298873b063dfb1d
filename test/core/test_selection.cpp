#include "ppf_bin_picking/core/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kPixels = 400;
constexpr double kLeastScore = 0.4;  // as the header says

/// Evidence that confirms a run of pixels with weight 1.
PoseEvidence confirming(std::uint32_t first, std::uint32_t count)
{
  PoseEvidence evidence;
  for (std::uint32_t i = 0; i < count; ++i)
    evidence.confirmed.push_back({first + i, 1.0F});
  evidence.confirmed_weight = count;
  evidence.visible_px = static_cast<int>(count);
  return evidence;
}

std::vector<std::size_t> indices(const std::vector<SelectedPose>& selected)
{
  std::vector<std::size_t> all;
  for (const SelectedPose& pose : selected)
    all.push_back(pose.candidate);
  return all;
}

/// The same by the header's words: all balances anew after every pose taken.
std::vector<SelectedPose> slowSelection(const std::vector<PoseEvidence>& candidates)
{
  std::vector<SelectedPose> selected;
  std::vector<bool> owned(kPixels, false), done(candidates.size(), false);
  for (;;)
  {
    std::vector<SelectedPose> standing;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      double free = 0;
      for (const PoseEvidence::Pixel& pixel : candidates[i].confirmed)
        free += owned[pixel.index] ? 0.0 : pixel.weight;
      if (!done[i] && poseScore(candidates[i], free) >= kLeastScore)
        standing.push_back({i, free, evidenceBalance(candidates[i], free)});
    }
    const auto best = std::max_element(standing.begin(), standing.end(),
                                       [](const SelectedPose& a, const SelectedPose& b)
                                       { return a.balance < b.balance; });
    if (best == standing.end()) return selected;
    selected.push_back(*best);
    done[best->candidate] = true;
    for (const PoseEvidence::Pixel& pixel : candidates[best->candidate].confirmed)
      owned[pixel.index] = true;
  }
}

std::vector<SelectedPose> select(const std::vector<PoseEvidence>& candidates)
{
  std::vector<const PoseEvidence*> pointers;
  for (const PoseEvidence& evidence : candidates)
    pointers.push_back(&evidence);
  return selectPoses(pointers, kPixels);
}

TEST(SelectPoses, leavesOutAPoseThatClaimsTakenPixels)
{
  const auto selected = select({confirming(0, 100), confirming(0, 90)});
  EXPECT_EQ(indices(selected), (std::vector<std::size_t>{0}));
}

TEST(SelectPoses, keepsAPoseWithEnoughPixelsOfItsOwn)
{
  // 41 of its 100 pixels are its own: a score of 0.41. 39 are not enough.
  const auto kept = select({confirming(0, 110), confirming(51, 100)});
  ASSERT_EQ(indices(kept), (std::vector<std::size_t>{0, 1}));
  EXPECT_DOUBLE_EQ(kept[1].confirmed, 41);
  const auto dropped = select({confirming(0, 110), confirming(49, 100)});
  EXPECT_EQ(indices(dropped), (std::vector<std::size_t>{0}));
}

TEST(SelectPoses, takesTheBestBalanceFirstAndTheFirstOfEqualOnes)
{
  PoseEvidence contradicted = confirming(0, 100);
  contradicted.looked_through = 20;  // worth 60 pixels
  const auto selected =
      select({confirming(100, 50), contradicted, confirming(200, 90), confirming(300, 50)});
  EXPECT_EQ(indices(selected), (std::vector<std::size_t>{2, 0, 3, 1}));
  EXPECT_DOUBLE_EQ(selected[3].balance, 40);
}

TEST(SelectPoses, rechecksThePoseOnTopAfterOthersTookItsPixels)
{
  // The second has the second best balance until the first takes half of it.
  const auto selected = select({confirming(0, 100), confirming(50, 95), confirming(200, 30)});
  EXPECT_EQ(indices(selected), (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_DOUBLE_EQ(selected[2].confirmed, 45);
  EXPECT_DOUBLE_EQ(selected[2].balance, 45 - 50);
}

TEST(SelectPoses, leavesOutNoneForANegativeBalanceAlone)
{
  PoseEvidence hidden = confirming(0, 50);
  hidden.occluded = 1000;
  const auto selected = select({hidden});
  ASSERT_EQ(selected.size(), 1U);
  EXPECT_LT(selected[0].balance, 0);
}

TEST(SelectPoses, leavesOutLowScoresAndPosesWithoutEvidence)
{
  PoseEvidence poor = confirming(0, 39);
  poor.looked_through = 61;
  PoseEvidence fair = confirming(100, 41);
  fair.looked_through = 59;
  EXPECT_EQ(indices(select({poor, PoseEvidence(), fair})), (std::vector<std::size_t>{2}));
  EXPECT_TRUE(select({}).empty());
}

TEST(SelectPoses, aPoseLeftOutTakesNoPixels)
{
  PoseEvidence large = confirming(0, 100);
  large.looked_through = 16;  // balance 52, but no pixels are taken by what is left out
  large.missing = 400;        // score 100 / 276
  large.outline_held = 100;   // the best balance all the same
  const auto selected = select({confirming(0, 60), large});
  EXPECT_EQ(indices(selected), (std::vector<std::size_t>{0}));
  EXPECT_DOUBLE_EQ(selected[0].confirmed, 60);
}

TEST(SelectPoses, selectsAsAPlainGreedySearchDoes)
{
  std::mt19937 rng(12);
  std::uniform_real_distribution<double> uniform;
  std::size_t taken = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    SCOPED_TRACE(trial);
    std::vector<PoseEvidence> candidates(20);
    for (PoseEvidence& evidence : candidates)
    {
      const auto first = static_cast<std::uint32_t>(rng() % 300);
      for (std::uint32_t i = first; i < first + 5 + rng() % 95; ++i)
        if (rng() % 4 != 0) evidence.confirmed.push_back({i, static_cast<float>(rng() % 5) / 4});
      for (const PoseEvidence::Pixel& pixel : evidence.confirmed)
        evidence.confirmed_weight += pixel.weight;
      evidence.looked_through = 10 * uniform(rng);
      evidence.missing = 20 * uniform(rng);
      evidence.occluded = 30 * uniform(rng);
      evidence.outline_held = 5 * uniform(rng);
      evidence.outline_broken = 3 * uniform(rng);
    }
    const auto fast = select(candidates), slow = slowSelection(candidates);
    ASSERT_EQ(indices(fast), indices(slow));
    for (std::size_t i = 0; i < fast.size(); ++i)
    {
      EXPECT_DOUBLE_EQ(fast[i].confirmed, slow[i].confirmed);
      EXPECT_DOUBLE_EQ(fast[i].balance, slow[i].balance);
    }
    taken += fast.size();
  }
  EXPECT_GT(taken, 800U);
}
}  // namespace
}  // namespace ppf_bin_picking

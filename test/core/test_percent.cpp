#include "ppf_bin_picking/core/percent.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
TEST(Percent, isRoundedToTheDigitsAskedFor)
{
  EXPECT_EQ(percent(0.425), "42 %");  // halves go to the even digit
  EXPECT_EQ(percent(0.426), "43 %");
  EXPECT_EQ(percent(0.4256, 1), "42.6 %");
  EXPECT_EQ(percent(0), "0 %");
  EXPECT_EQ(percent(1), "100 %");
}

TEST(PercentBeside, hasTheDigitsInWhichShareAndLimitDiffer)
{
  const auto expect = [](double share, double limit, const char* first, const char* second)
  {
    const ShareAndLimit text = percentBeside(share, limit);
    EXPECT_EQ(text.share, first);
    EXPECT_EQ(text.limit, second);
  };
  expect(0.42, 0.35, "42 %", "35 %");
  expect(0.897, 0.9, "89.7 %", "90.0 %");
  expect(0.89996, 0.9, "89.996 %", "90.000 %");
  expect(0.9, 0.9, "90.000 %", "90.000 %");
}
}  // namespace
}  // namespace ppf_bin_picking

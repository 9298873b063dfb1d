#include "ppf_bin_picking/io/key_check.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
TEST(NearestName, hasTheFewestEdits)
{
  const std::vector<std::string> names = {"lambda", "minpts", "min_score", "threads"};
  EXPECT_EQ(nearestName("lamda", names), "lambda");
  EXPECT_EQ(nearestName("min_scores", names), "min_score");
  EXPECT_EQ(nearestName("minpst", names), "minpts");
  EXPECT_EQ(nearestName("thread", names), "threads");
}

TEST(NearestName, isEmptyWithoutNames)
{
  EXPECT_EQ(nearestName("lambda", {}), "");
}

TEST(RequireKnownKey, namesTheKeyAndItsNeighbour)
{
  EXPECT_NO_THROW(requireKnownKey("f.yaml", "unit", {"mesh", "unit"}));
  EXPECT_EQ(inputError(
                [] {
                  requireKnownKey("f.yaml", "unti", {"mesh", "unit"});
                }),
            "f.yaml: unknown key 'unti': the nearest known name is 'unit'");
  EXPECT_EQ(inputError([] { requireKnownKey("f.yaml", "unti", {}); }),
            "f.yaml: unknown key 'unti': remove it");
}
}  // namespace
}  // namespace ppf_bin_picking

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

TEST(SimilarName, isOneThatCanBeMeant)
{
  const std::vector<std::string> names = {"width", "step_rel", "unit", "min_score", "fx"};
  EXPECT_EQ(similarName("stepsrel", names), "step_rel");
  EXPECT_EQ(similarName("unti", names), "unit");  // an exchange of neighbours is one edit
  EXPECT_EQ(similarName("mn_scor", names), "min_score");
  EXPECT_EQ(similarName("units", names), "unit");
  EXPECT_EQ(similarName("climbing", {"min_score", "climb"}), "climb");
  EXPECT_EQ(similarName("max_slide", {"minpts", "v_min", "max_slide_share"}), "max_slide_share");
  EXPECT_EQ(similarName("time", {"climb", "time_limit_s"}), "time_limit_s");
  EXPECT_EQ(similarName("mind", {"min", "step_rel"}), "min");
  EXPECT_EQ(similarName("minutes", {"min", "step_rel"}), "");  // three letters begin many words
  EXPECT_EQ(similarName("detector", names), "");
  EXPECT_EQ(similarName("mesh", names), "");
  EXPECT_EQ(similarName("x", names), "");
  EXPECT_EQ(similarName("", names), "");
  EXPECT_EQ(similarName("unit", {}), "");
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

TEST(RequireKnownKey, listsFewNamesWhereNoneIsNear)
{
  EXPECT_EQ(inputError(
                [] {
                  requireKnownKey("f.yaml", "colour", {"mesh", "unit"});
                }),
            "f.yaml: unknown key 'colour': known are mesh, unit");
  EXPECT_EQ(
      inputError([] { requireKnownKey("f.yaml", "colour", std::vector<std::string>(13, "mesh")); }),
      "f.yaml: unknown key 'colour': no known name is like it; remove it, or check that "
      "this is the file you mean");
}
}  // namespace
}  // namespace ppf_bin_picking

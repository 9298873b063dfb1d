#include "ppf_bin_picking/core/detector_config.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace ppf_bin_picking
{
namespace
{
TEST(DetectorConfig, isUsableAsItComes)
{
  EXPECT_TRUE(DetectorConfig().problems().empty());
}

TEST(DetectorConfig, namesEveryProblem)
{
  DetectorConfig config;
  config.lambda = 1.5;
  config.model.n_angle = 3;
  config.min_score = std::numeric_limits<double>::quiet_NaN();
  const auto problems = config.problems();
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_NE(problems[0].find("n_angle"), std::string::npos);
  EXPECT_NE(problems[1].find("lambda"), std::string::npos);
  EXPECT_NE(problems[2].find("min_score"), std::string::npos);
}

TEST(DetectorConfig, isBrokenByAnyWildNumber)
{
  std::set<std::string> names;
  const auto spoil = [&](const char* name, auto&)
  {
    DetectorConfig config;
    const auto spoil_one = [&](const char* other, auto& field)
    {
      using Field = std::decay_t<decltype(field)>;
      if (std::string(other) != name) return;
      if constexpr (std::is_same_v<Field, double>) field = std::numeric_limits<double>::quiet_NaN();
      if constexpr (std::is_same_v<Field, int>) field = -1;
    };
    visitFields(config, spoil_one);
    names.insert(name);
    const std::string wanted(name);
    if (wanted == "clustering" || wanted == "use_cloud_normals" || wanted == "mismatch_test" ||
        wanted == "climb")
      return;
    EXPECT_EQ(config.problems().size(), 1U) << name;
  };
  DetectorConfig config;
  visitFields(config, spoil);
  EXPECT_GT(names.size(), 20U);
}

TEST(Clustering, isReadBackFromItsWord)
{
  EXPECT_EQ(clusteringFromString(toString(Clustering::kGreedy)), Clustering::kGreedy);
  EXPECT_EQ(clusteringFromString(toString(Clustering::kDbscan)), Clustering::kDbscan);
  EXPECT_THROW(clusteringFromString("kmeans"), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking

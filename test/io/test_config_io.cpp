#include "ppf_bin_picking/io/config_io.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
DetectorConfig configOf(const std::string& text)
{
  return withSettings(DetectorConfig(), YAML::Load(text), "f.yaml");
}

std::string configError(const std::string& text)
{
  return inputError([&] { configOf(text); });
}

TEST(DetectorConfigFile, ofThePackageHoldsEveryFieldWithItsDefault)
{
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  const std::string path = (root / "config" / "detector.yaml").string();
  EXPECT_EQ(toYaml(loadDetectorConfig(path)), toYaml(DetectorConfig()));
  std::vector<std::string> keys;
  for (const auto& item : YAML::LoadFile(path))
    keys.push_back(item.first.Scalar());
  EXPECT_EQ(keys, detectorConfigKeys());
}

TEST(DetectorConfigFile, ofTheFastSettingsChangesNothingThatModelsDependOn)
{
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  const DetectorConfig fast = loadDetectorConfig((root / "config" / "fast.yaml").string());
  const DetectorConfig usual;
  EXPECT_TRUE(fast.problems().empty());
  EXPECT_TRUE(fast.model == usual.model);
  EXPECT_LT(fast.reference_share, usual.reference_share);
  EXPECT_LT(fast.icp_iterations, usual.icp_iterations);
  EXPECT_GT(fast.min_sparse_balance, usual.min_sparse_balance);
}

TEST(DetectorConfigFile, keepsDefaultsOfWhatItLeavesOut)
{
  const DetectorConfig config = configOf("{lambda: 1, n_angle: 24, clustering: greedy}");
  EXPECT_EQ(config.lambda, 1.0);
  EXPECT_EQ(config.model.n_angle, 24);
  EXPECT_EQ(config.clustering, Clustering::kGreedy);
  EXPECT_EQ(config.model.step_rel, DetectorConfig().model.step_rel);
  EXPECT_EQ(toYaml(configOf("# nothing but a comment\n")), toYaml(DetectorConfig()));
}

TEST(DetectorConfigFile, isReadBackAsWritten)
{
  DetectorConfig config;
  config.eps_rel = 0.1 + 0.2;
  config.mismatch_test = false;
  config.clustering = Clustering::kGreedy;
  config.minpts = 7;
  EXPECT_EQ(toYaml(configOf(toYaml(config))), toYaml(config));
}

TEST(DetectorConfigFile, namesAMisspeltKey)
{
  EXPECT_EQ(configError("lamda: 1"),
            "f.yaml: unknown key 'lamda': the nearest known name is 'lambda'");
}

TEST(DetectorConfigFile, isNotTheParametersOfANode)
{
  const TemporaryFolder folder;
  const std::string path = folder.write("cell.yaml", "detector: {lambda: 0.5}\n");
  EXPECT_EQ(
      inputError([&] { loadDetectorConfig(path); }),
      path +
          " holds the parameters of a node; the settings are those below its 'detector': give a "
          "file with the settings at its top, such as config/detector.yaml");
}

TEST(DetectorConfigFile, namesAMistypedValue)
{
  EXPECT_EQ(configError("lambda: '1'"),
            "f.yaml: lambda is '1': give a plain decimal number such as 0.35, without quotes, "
            "exponent or deg()");
  expectHolds(configError("group_angle_rad: deg(20)"), "group_angle_rad is 'deg(20)'");
  expectHolds(configError("n_angle: 30.5"), "n_angle is '30.5': give a whole number");
  expectHolds(configError("mismatch_test: 1"), "mismatch_test is '1': give true or false");
  expectHolds(configError("clustering: kmeans"), "clustering is 'kmeans': give dbscan or greedy");
  expectHolds(configError("clustering: [dbscan]"), "clustering is a list");
}

TEST(DetectorConfigFile, refusesValuesOutOfRange)
{
  const std::string message = configError("{lambda: 2, n_angle: 1}");
  expectHolds(message, "f.yaml: ");
  expectHolds(message, "n_angle is 1: give a value from");
  expectHolds(message, "lambda is 2: give a value from");
}

FramedRegion regionOf(const std::string& text)
{
  return readRegion(YAML::Load(text), "r.yaml");
}

std::string regionError(const std::string& text)
{
  return inputError([&] { regionOf(text); });
}

TEST(Region, isABoxInTheCloudsFrame)
{
  const FramedRegion framed = regionOf("{min: [-1, -2, 0.5], max: [1, 2, 3]}");
  EXPECT_TRUE(framed.region.contains({0.9F, 1.9F, 0.6F}));
  EXPECT_FALSE(framed.region.contains({0.9F, 1.9F, 0.4F}));
  EXPECT_EQ(framed.frame, "");
}

TEST(Region, isTurnedByItsPose)
{
  const FramedRegion framed = regionOf(
      "{min: [0, 0, 0], max: [1, 2, 3], frame: bin, "
      "pose: [0, -1, 0, 10,  1, 0, 0, 20,  0, 0, 1, 30,  0, 0, 0, 1]}");
  EXPECT_EQ(framed.frame, "bin");
  EXPECT_TRUE(framed.region.contains({8.5F, 20.5F, 32.5F}));  // box: 0.5, 1.5, 2.5
  EXPECT_FALSE(framed.region.contains({10.5F, 20.5F, 32.5F}));
}

TEST(Region, isRefusedUnlessItHasAnInside)
{
  expectHolds(regionError("{min: [0, 0, 0], max: [1, 0, 1]}"), "min is not below max");
  expectHolds(regionError("{min: [0, 0, 0]}"), "max is missing");
  expectHolds(regionError("{min: [0, 0], max: [1, 1, 1]}"), "min is a list of 2");
  expectHolds(regionError("{min: [0, 0, 600], max: [300, 400, 600.5]}"),
              "measures 500 m across, more than 50 m: give its corners in metres");
  expectHolds(regionError("{min: [0, 0, 0], max: [1, 1, 1], pos: []}"),
              "nearest known name is 'pose'");
}

TEST(Region, isRefusedUnlessItsPoseIsRigid)
{
  const std::string box = "{min: [0, 0, 0], max: [1, 1, 1], pose: ";
  for (const char* pose : {"[2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1]}",
                           "[1, 0, 0, 0,  0, 1, 0, 0,  0, 0, -1, 0,  0, 0, 0, 1]}",
                           "[1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 2]}",
                           "[0, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 1]}"})
    expectHolds(regionError(box + pose), "pose is not a rotation and a translation");
}

TEST(RegionFile, needsTheCloudsOwnFrame)
{
  const TemporaryFolder folder;
  const std::string box = "min: [0, 0, 0]\nmax: [1, 1, 2]\n";
  EXPECT_NEAR(loadRegion(folder.write("r.yaml", box)).diagonal(), std::sqrt(6.0), 1e-12);
  expectHolds(inputError([&] { loadRegion(folder.write("r.yaml", box + "frame: base\n")); }),
              "frame needs tf");
}
}  // namespace
}  // namespace ppf_bin_picking

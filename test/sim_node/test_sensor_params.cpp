#include "sensor_params.hpp"
#include "support/files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

namespace ppf_bin_picking
{
namespace
{
DepthSensor read(const std::string& yaml)
{
  return readDepthSensor({YAML::Load(yaml), "cell.yaml: sensor", depthSensorKeys()});
}

std::string refusal(const std::string& yaml)
{
  return inputError([&] { read(yaml); });
}

/// All fields, to compare.
std::vector<double> values(const DepthSensor& sensor)
{
  std::vector<double> values;
  visitSensorFields(sensor, [&](const char*, auto value, double, double)
                    { values.push_back(static_cast<double>(value)); });
  return values;
}

TEST(ReadDepthSensor, takesThePresetAndWhatDiffers)
{
  EXPECT_EQ(values(read("{}")), values(sensorPreset("industrial")));
  for (const std::string& name : sensorPresetNames())
    EXPECT_EQ(values(read("preset: " + name)), values(sensorPreset(name)));
  DepthSensor expected = sensorPreset("low_cost");
  expected.camera.width = 320;
  expected.camera.fx = 500.5F;
  expected.dropout_share = 0;
  EXPECT_EQ(values(read("{preset: low_cost, width: 320, fx: 500.5, dropout_share: 0}")),
            values(expected));
}

TEST(ReadDepthSensor, readsEveryField)
{
  int number = 0;
  visitSensorFields(
      DepthSensor(),
      [&](const char* name, auto value, double low, double high)
      {
        ++number;
        for (const double limit : {low, high})
        {
          const auto got = values(read("{" + std::string(name) + ": " + plainDecimal(limit) + "}"));
          EXPECT_EQ(got[number - 1], static_cast<double>(static_cast<decltype(value)>(limit)))
              << name;
        }
      });
  EXPECT_EQ(number + 1U, depthSensorKeys().size());
}

TEST(ReadDepthSensor, refusesWhatItCannotUse)
{
  EXPECT_EQ(refusal("preset: industrail"),
            "cell.yaml: sensor: preset: there is no sensor preset 'industrail': give one of clean, "
            "industrial, low_cost; the nearest is 'industrial'");
  EXPECT_EQ(
      refusal("{glare_rad: -0.1, width: 0}"),
      "cell.yaml: sensor: width is 0: give a value from 1 to 10000; glare_rad is -0.1: give a "
      "value from 0 to 1.5708");
  EXPECT_NE(refusal("flying_reach_px: 1.5").find("flying_reach_px is '1.5': give a whole number"),
            std::string::npos);
  EXPECT_NE(refusal("dropout_shares: 0").find("the nearest known name is 'dropout_share'"),
            std::string::npos);
}

/// The file shown to users names every parameter, with the value that the preset has.
TEST(ReadDepthSensor, agreesWithTheConfigFile)
{
  const std::filesystem::path root = PACKAGE_FOLDER;
  std::ifstream file(root / "config" / "simulated_cell.yaml");
  ASSERT_TRUE(file);
  std::string all;
  std::string preset_alone = "sensor:\n";
  for (std::string line; std::getline(file, line);)
  {
    std::smatch match;
    const bool hidden = std::regex_match(line, match, std::regex("  # (\\w+: .*)"));
    all += (hidden ? "  " + match.str(1) : line) + "\n";
    if (hidden) preset_alone += "  " + match.str(1) + "\n";
  }
  const YAML::Node sensor = YAML::Load(all)["sensor"];
  for (const std::string& key : depthSensorKeys())
    EXPECT_TRUE(sensor[key]) << key;
  const YamlMap shown(YAML::Load(preset_alone)["sensor"], "shown", depthSensorKeys());
  EXPECT_EQ(values(readDepthSensor(shown)), values(sensorPreset("industrial")));
  EXPECT_EQ(values(read(YAML::Dump(sensor)))[0], 640);
}
}  // namespace
}  // namespace ppf_bin_picking

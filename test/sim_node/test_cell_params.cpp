#include "cell_params.hpp"
#include "support/files.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
const std::filesystem::path kPackage = PACKAGE_FOLDER;

CellParams read(const std::string& yaml)
{
  return readCellParams(YAML::Load(yaml), "/cell");
}

std::string refusal(const std::string& yaml)
{
  return inputError([&] { read(yaml); });
}

/// All values but the sensor's, to compare.
std::vector<double> numbers(const CellParams& params)
{
  const CellSettings& cell = params.cell;
  std::vector<double> values = {static_cast<double>(params.count),
                                static_cast<double>(params.seed),
                                params.rate_hz,
                                cell.bin.wall_m,
                                cell.pick.tolerance_rel,
                                cell.pick.contact_m,
                                cell.pick.push_rel};
  for (const Eigen::Vector3d& vector :
       {cell.bin.size_m, cell.bin_position_m, cell.camera_position_m, cell.camera_target_m})
    values.insert(values.end(), vector.data(), vector.data() + 3);
  return values;
}

TEST(CellParams, areThoseOfTheConfigFile)
{
  YAML::Node file = YAML::LoadFile((kPackage / "config/simulated_cell.yaml").string());
  file["part"] = "part.yaml";
  const CellParams shown = readCellParams(file, "file");
  const CellParams defaults = read("part: part.yaml");
  EXPECT_EQ(numbers(shown), numbers(defaults));
  EXPECT_EQ(shown.base_frame, defaults.base_frame);
  EXPECT_EQ(shown.bin_frame, defaults.bin_frame);
  EXPECT_EQ(shown.camera_frame, defaults.camera_frame);
  EXPECT_EQ(shown.cell.sensor.noise_at_1m_m, defaults.cell.sensor.noise_at_1m_m);
  for (const char* key : {"count", "seed", "rate_hz", "base_frame", "bin_frame", "camera_frame",
                          "bin", "camera", "sensor", "pick"})
    EXPECT_TRUE(file[key]) << key;
}

TEST(CellParams, areAllRead)
{
  const CellParams params = read(
      "{part: a.yaml, count: 0, seed: 7, rate_hz: 2.5, hull_folder: /h, base_frame: w, bin_frame: "
      "b, camera_frame: c, bin: {size_m: [1, 2, 3], wall_m: 0.5, position_m: [4, 5, 6]}, camera: "
      "{position_m: [7, 8, 9], target_m: [10, 11, 12]}, sensor: {preset: clean, width: 99}, pick: "
      "{tolerance_rel: 0.2, contact_m: 0.003, push_rel: 0.04}}");
  EXPECT_EQ(numbers(params), (std::vector<double>{0, 7, 2.5, 0.5, 0.2, 0.003, 0.04, 1, 2, 3, 4, 5,
                                                  6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(
      params.part + params.hull_folder + params.base_frame + params.bin_frame + params.camera_frame,
      "a.yaml/hwbc");
  EXPECT_EQ(params.cell.sensor.camera.width, 99);
  EXPECT_EQ(params.cell.sensor.baseline_m, 0);
}

TEST(CellParams, areCheckedLikeOthers)
{
  EXPECT_NE(refusal("count: 3").find("part is missing"), std::string::npos) << refusal("count: 3");
  EXPECT_EQ(refusal("{part: p, conut: 3}"),
            "/cell: unknown key 'conut': the nearest known name is 'count'");
  EXPECT_EQ(refusal("{part: p, count: 501}"), "/cell: count is 501: give a value from 0 to 500");
  EXPECT_EQ(refusal("{part: p, rate_hz: -1}"), "/cell: rate_hz is -1: give a value from 0 to 100");
  EXPECT_NE(refusal("{part: p, seed: 1.5}").find("seed is '1.5'"), std::string::npos);
  EXPECT_NE(refusal("{part: p, bin: {size_m: [1, 0, 1]}}").find("size_m is out of range"),
            std::string::npos);
  EXPECT_NE(refusal("{part: p, pick: {contact_m: 0}}").find("contact_m is 0: give a value from"),
            std::string::npos);
  EXPECT_NE(refusal("{part: p, pick: {tolerance: 1}}").find("'tolerance_rel'"), std::string::npos);
  EXPECT_NE(refusal("{part: p, sensor: {preset: cheap}}").find("'cheap'"), std::string::npos);
}

TEST(LoadCellPart, keepsTheHullsInTheFolder)
{
  const TemporaryFolder folder;
  CellParams params;
  params.part = (kPackage / "config/parts/cylinder.yaml").string();
  params.hull_folder = folder.file("hulls");
  const LoadedCellPart loaded = loadCellPart(params);
  EXPECT_EQ(loaded.model_id, "cylinder");
  EXPECT_TRUE(loaded.part.symmetries.revolution());
  EXPECT_FALSE(loaded.part.hulls.empty());
  EXPECT_FALSE(std::filesystem::is_empty(params.hull_folder));
  EXPECT_EQ(loadCellPart(params).part.hulls.size(), loaded.part.hulls.size());
  params.part = "nowhere.yaml";
  EXPECT_NE(inputError([&] { loadCellPart(params); }).find("nowhere.yaml"), std::string::npos);
}
}  // namespace
}  // namespace ppf_bin_picking

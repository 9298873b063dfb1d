#include "ppf_bin_picking/core/model_renderer.hpp"

#include "ppf_bin_picking/io/depth_io.hpp"
#include "ppf_bin_picking/io/mesh_io.hpp"
#include "ppf_bin_picking/io/part_io.hpp"
#include "ppf_bin_picking/io/rigid_pose.hpp"

#include "support/program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>

namespace ppf_bin_picking
{
namespace
{
const char* const kFiles[] = {"depth.png", "camera.yaml", "gt.json", "roi.yaml", "preview.jpg"};

class SimulateScene : public testing::Test
{
protected:
  Outcome simulate(const std::string& output, const std::vector<std::string>& more) const
  {
    std::vector<std::string> all = {
        "--part", part_, "--output", folder_.file(output), "--hulls", hulls().file("hulls")};
    all.insert(all.end(), more.begin(), more.end());
    return runBuiltTool("simulate_scene", all, folder_);
  }

  /// Kept for all tests, as hulls take longer than the rest.
  static const TemporaryFolder& hulls()
  {
    static const TemporaryFolder folder;
    return folder;
  }

  TemporaryFolder folder_;
  const std::string part_ = std::string(PACKAGE_FOLDER) + "/config/parts/bolt.yaml";
};

/// What of the truth's parts a pixel should show: the nearest one and how deep it is.
struct ExpectedPixel
{
  std::size_t part = 0;
  float depth_m = std::numeric_limits<float>::infinity();
};

/// All parts of a scene at their true poses, drawn over each other.
struct DrawnTruth
{
  DrawnTruth(const nlohmann::json& truth, const RenderableMesh& part, const PinholeCamera& camera)
      : pixels(static_cast<std::size_t>(camera.width) * camera.height)
  {
    RenderedPart drawn;
    for (const auto& object : truth["objects"])
    {
      const auto pose = rigidPose(object["pose"].get<std::vector<double>>()).value();
      renderPart(part, pose.cast<float>(), camera, drawn);
      alone.push_back(0);
      for (int row = 0; row < drawn.height; ++row)
        for (int column = 0; column < drawn.width; ++column)
          add(drawn, column, row, camera.width);
    }
  }

  void add(const RenderedPart& drawn, int column, int row, int width)
  {
    const float depth_m = drawn.depthAt(column, row);
    if (depth_m == 0) return;
    ++alone.back();
    ExpectedPixel& pixel =
        pixels[static_cast<std::size_t>(drawn.top + row) * width + drawn.left + column];
    if (depth_m < pixel.depth_m) pixel = {alone.size() - 1, depth_m};
  }

  std::vector<ExpectedPixel> pixels;
  std::vector<int> alone;  ///< Pixels of each part if there were no other.
};

TEST_F(SimulateScene, theSameArgumentsGiveTheSameBytes)
{
  const std::vector<std::string> arguments = {"--count", "6",        "--seed",
                                              "7",       "--preset", "low_cost"};
  const Outcome first = simulate("a", arguments);
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(simulate("b", arguments).status, 0);  // now with hulls from a file
  for (const char* file : kFiles)
    EXPECT_EQ(contentOf(folder_.file("b/bolt/low_cost-6-7/") + file),
              contentOf(folder_.file("a/bolt/low_cost-6-7/") + file))
        << file;
  ASSERT_EQ(simulate("b", {"--count", "6", "--seed", "8", "--preset", "low_cost"}).status, 0);
  EXPECT_NE(contentOf(folder_.file("b/bolt/low_cost-6-8/depth.png")),
            contentOf(folder_.file("a/bolt/low_cost-6-7/depth.png")));
}

TEST_F(SimulateScene, allSensorsSeeTheSamePile)
{
  ASSERT_EQ(simulate("a", {"--count", "3", "--preset", "clean", "low_cost"}).status, 0);
  const auto in_bin = [&](const std::string& scene)
  {
    const auto truth =
        nlohmann::json::parse(contentOf(folder_.file("a/bolt/" + scene + "/gt.json")));
    const auto pose_of = [](const nlohmann::json& node)
    { return rigidPose(node["pose"].get<std::vector<double>>()).value(); };
    std::vector<Eigen::Isometry3d> poses;
    for (const auto& object : truth["objects"])
      poses.push_back(pose_of(truth["bin"]).inverse() * pose_of(object));
    return poses;
  };
  const auto clean = in_bin("clean-3-1");
  const auto low_cost = in_bin("low_cost-3-1");
  ASSERT_EQ(clean.size(), 3U);
  for (std::size_t k = 0; k < clean.size(); ++k)
    EXPECT_TRUE(clean[k].isApprox(low_cost.at(k), 1e-9));
}

TEST_F(SimulateScene, depthAndTruthAgree)
{
  ASSERT_EQ(simulate("a", {"--count", "10", "--preset", "clean"}).status, 0);
  const std::string scene = folder_.file("a/bolt/clean-10-1/");
  const DepthCamera camera = loadDepthCamera(scene + "camera.yaml");
  const PointCloud cloud = loadDepthCloud(scene + "depth.png", camera, 1000000);
  const auto truth = nlohmann::json::parse(contentOf(scene + "gt.json"));
  ASSERT_EQ(truth["objects"].size(), 10U);
  const PartDescription part = loadPart(folder_.file("a/bolt/part.yaml"));
  const RenderableMesh mesh(loadMesh(part.mesh_file, part.unit).mesh);
  const DrawnTruth drawn(truth, mesh, camera.pinhole);
  std::vector<int> seen(10, 0);
  int shown = 0;
  int equal = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
  {
    const float expected_m = drawn.pixels[i].depth_m;
    const float measured_m = cloud.points[i].z();
    if (!std::isfinite(expected_m)) continue;
    // Walls of the bin may hide a part, never may anything be seen behind one.
    ++shown;
    equal += std::abs(measured_m - expected_m) < 0.00002F ? 1 : 0;
    if (measured_m > expected_m - 0.0005F) ++seen[drawn.pixels[i].part];
  }
  ASSERT_GT(shown, 40000);
  EXPECT_GT(equal, 0.98 * shown);
  for (std::size_t k = 0; k < seen.size(); ++k)
    EXPECT_NEAR(truth["objects"][k]["visibility"], seen[k] / static_cast<double>(drawn.alone[k]),
                0.02);
}

TEST_F(SimulateScene, theRegionIsTheInsideOfTheBinAndAboveIt)
{
  ASSERT_EQ(simulate("a", {"--count", "5", "--preset", "clean"}).status, 0);
  const std::string scene = folder_.file("a/bolt/clean-5-1/");
  const auto truth = nlohmann::json::parse(contentOf(scene + "gt.json"));
  const YAML::Node roi = YAML::LoadFile(scene + "roi.yaml");
  EXPECT_EQ(roi["pose"].as<std::vector<double>>(), truth["bin"]["pose"].get<std::vector<double>>());
  const auto size = truth["bin"]["size"].get<std::vector<double>>();
  const auto high = roi["max"].as<std::vector<double>>();
  EXPECT_NEAR(high[0], size[0] / 2 - 0.002, 1e-12);
  EXPECT_NEAR(high[1], size[1] / 2 - 0.002, 1e-12);
  EXPECT_NEAR(high[2], 2 * size[2], 1e-12);
  EXPECT_NEAR(roi["min"].as<std::vector<double>>()[2], 0.003, 1e-12);
}

TEST_F(SimulateScene, theOtherProgramsReadIt)
{
  ASSERT_EQ(simulate("a", {"--count", "4"}).status, 0);
  const std::string scene = folder_.file("a/bolt/industrial-4-1/");
  const Outcome found =
      runBuiltTool("detect_poses",
                   {"--part", folder_.file("a/bolt/part.yaml"), "--depth", scene + "depth.png",
                    "--camera", scene + "camera.yaml", "--roi", scene + "roi.yaml", "--output",
                    folder_.write("results/bolt/industrial-4-1.json", "")},
                   folder_);
  ASSERT_EQ(found.status, 0) << found.err;
  const Outcome judged = runBuiltTool(
      "evaluate_poses",
      {folder_.file("a"), folder_.file("results"), "--json", folder_.file("judged.json")}, folder_);
  ASSERT_EQ(judged.status, 0) << judged.err;
  const auto json = nlohmann::json::parse(contentOf(folder_.file("judged.json")));
  EXPECT_EQ(json["summary"]["bolt"]["scenes"], 1);
  EXPECT_GT(json["summary"]["bolt"]["right"], 0);
}

TEST_F(SimulateScene, keepsADataSetsPart)
{
  ASSERT_EQ(simulate("a", {"--count", "2", "--preset", "clean"}).status, 0);
  const std::string part = folder_.file("a/bolt/part.yaml");
  const std::string mesh = folder_.file("a/bolt/model.stl");
  const std::string before = contentOf(part), mesh_before = contentOf(mesh);
  const std::vector<std::string> more = {"--count", "2",        "--seed",
                                         "2",       "--output", folder_.file("a")};
  const auto from = [&](const std::string& file)
  {
    std::vector<std::string> all = {"--part", file};
    all.insert(all.end(), more.begin(), more.end());
    return runBuiltTool("simulate_scene", all, folder_);
  };
  EXPECT_EQ(from(part).status, 0);
  EXPECT_EQ(contentOf(part), before);
  const std::string other = folder_.write(
      "other/part.yaml", "unit: mm\nmodel_id: bolt\nmesh: " + mesh + "\nsymmetries_discrete: []\n");
  expectRefusal(from(other), "simulate_scene", "belongs to another part");
  EXPECT_EQ(contentOf(part), before);
  EXPECT_EQ(contentOf(mesh), mesh_before);
}

TEST_F(SimulateScene, refusesBadArguments)
{
  const auto expect_refused =
      [&](const std::vector<std::string>& arguments, const std::string& sentence)
  { expectRefusal(simulate("a", arguments), "simulate_scene", sentence); };
  expect_refused({}, "--count is required");
  expect_refused({"--count", "0"}, "--count");
  expect_refused({"--count", "many"}, "--count");
  expect_refused({"--count", "3", "--preset", "cheap"}, "--preset");
  expect_refused({"--count", "3", "--seed", "-1"}, "--seed");
  folder_.write("file", "");
  expectRefusal(
      runBuiltTool("simulate_scene",
                   {"--part", part_, "--count", "3", "--output", folder_.file("file")}, folder_),
      "simulate_scene", "cannot be made");
  expectRefusal(
      runBuiltTool("simulate_scene",
                   {"--part", "none.yaml", "--count", "3", "--output", folder_.file("a")}, folder_),
      "simulate_scene", "none.yaml does not exist");
  EXPECT_FALSE(std::filesystem::exists(folder_.file("a")));
}
}  // namespace
}  // namespace ppf_bin_picking

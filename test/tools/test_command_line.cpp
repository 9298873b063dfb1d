#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/result_io.hpp"

#include "support/files.hpp"
#include "support/program.hpp"
#include "support/small_png.hpp"
#include "support/stl_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace ppf_bin_picking
{
namespace
{
constexpr int kBadInput = 2;
const char* const kPart = "unit: m\ndetector: {step_rel: 0.1}\n";

class CommandLine : public testing::Test
{
protected:
  Outcome run(const std::string& tool, const std::vector<std::string>& arguments) const
  {
    return runBuiltTool(tool, arguments, folder_);
  }

  void expectRefused(const std::string& tool, const std::vector<std::string>& arguments,
                     const std::string& part) const
  {
    expectRefusal(run(tool, arguments), tool, part);
    EXPECT_FALSE(std::filesystem::exists(result_));
  }

  /// Arguments of detect_poses for the small scene, then more.
  std::vector<std::string> detect(const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> all = {"--part",   part_,   "--depth",  depth_,
                                    "--camera", camera_, "--output", result_};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// A plane with a step, in which no tetrahedron is found.
  static std::string plane()
  {
    std::vector<std::uint16_t> levels(64 * 48, 6000);
    std::fill(levels.begin(), levels.begin() + 64 * 20, std::uint16_t{5900});
    return pngOf(levels, 64);
  }

  TemporaryFolder folder_;
  const std::string mesh_ = folder_.write("part/model.stl", binaryStl(tetrahedron(), 4));
  const std::string part_ = folder_.write("part/part.yaml", kPart);
  const std::string depth_ = folder_.write("depth.png", plane());
  const std::string camera_ = folder_.write(
      "camera.yaml",
      "{width: 64, height: 48, fx: 100.0, fy: 100.0, cx: 31.5, cy: 23.5, depth_unit_m: 0.001, "
      "frame_id: cam}");
  const std::string roi_ = folder_.write("roi.yaml", "{min: [-9, -9, 1], max: [9, 9, 9]}");
  const std::string model_ = folder_.file("part.ppf");
  const std::string result_ = folder_.file("result.json");
};

TEST_F(CommandLine, trainsAndDetectsAndChecks)
{
  EXPECT_EQ(run("train_model", {"--part", part_, "--output", model_}).status, 0);
  const Outcome outcome = run("detect_poses", detect({"--model", model_, "--roi", roi_}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  expectHolds(outcome.err, " ms  voting");
  const ResultFile file = loadResult(result_);
  EXPECT_EQ(file.frame_id, "cam");
  EXPECT_EQ(file.train_seconds, 0);
  EXPECT_GT(file.result.seconds, 0);
  EXPECT_EQ(file.result.roi_points, 64U * 48U);

  const std::string picture = folder_.file("poses.png");
  const Outcome check = run("check_poses", {result_, "--part", part_, "--depth", depth_, "--camera",
                                            camera_, "--all", "--image", picture});
  EXPECT_EQ(check.status, 0) << check.err;
  expectHolds(check.out, " suspicious\n");
  EXPECT_EQ(contentOf(picture).substr(1, 3), "PNG");
}

TEST_F(CommandLine, trainsFirstWithoutAModel)
{
  const Outcome outcome = run("detect_poses", detect({"--threads", "1"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(loadResult(result_).train_seconds, 0);
}

TEST_F(CommandLine, givesTheSameBytesTwice)
{
  const auto stripped = [&]
  {
    ResultFile file = loadResult(result_);
    file.train_seconds = file.result.seconds = 0;
    file.result.stages.clear();
    return toJson(file);
  };
  ASSERT_EQ(run("detect_poses", detect({"--threads", "1"})).status, 0);
  const std::string first = stripped();
  ASSERT_EQ(run("detect_poses", detect({"--threads", "2"})).status, 0);
  EXPECT_EQ(stripped(), first);
}

TEST_F(CommandLine, explainsAPose)
{
  const Outcome outcome = run("detect_poses", detect({"--explain", "0.1, 0 5.5 0 0 0.2 2"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* line : {"surface: ", "boundary: ", "candidates: ", "visible: ", "confirmed: ",
                           "contradicted: ", "missing: ", "outline: ", "score: ", "first looks: ",
                           "refinement: ", "coincides: ", "owner: ", "verdict:      failed at "})
    expectHolds(outcome.out, line);
  EXPECT_TRUE(std::filesystem::exists(result_));
}

TEST_F(CommandLine, refusesToExplainWhatIsNoPose)
{
  for (const char* text : {"1 2 3", "0 0 1 0 0 0 1 7", "0 0 one 0 0 0 1", "0 0 nan 0 0 0 1"})
    expectRefused("detect_poses", detect({"--explain", text}), "give seven numbers");
  expectRefused("detect_poses", detect({"--explain", "0 0 1 0 0 0 0"}), "has no length");
}

TEST_F(CommandLine, refusesEmptyValues)
{
  for (const char* option : {"--roi", "--model", "--config", "--explain"})
    expectRefused("detect_poses", detect({option, ""}),
                  std::string(option) + " is empty: give a value, or leave it out");
  expectRefused("evaluate_poses", {"", "results"}, "dataset is empty: give a value\n");
}

TEST_F(CommandLine, repeatsTheDetectionAndTellsHowLongItTook)
{
  const Outcome outcome = run("detect_poses", detect({"--repeat", "3"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expectHolds(outcome.err, "3 detections: first ");
  EXPECT_GT(loadResult(result_).result.seconds, 0);
  EXPECT_EQ(run("detect_poses", detect()).err.find("detections: first"), std::string::npos);
  EXPECT_EQ(run("detect_poses", detect({"--repeat", "0"})).status, 2);
}

TEST_F(CommandLine, explainsItself)
{
  for (const char* tool : {"train_model", "detect_poses", "check_poses"})
  {
    const Outcome outcome = run(tool, {"--help"});
    EXPECT_EQ(outcome.status, 0);
    expectHolds(outcome.out, "--part");
  }
}

TEST_F(CommandLine, isDocumentedWhole)
{
  const std::string document = contentOf(std::string(PACKAGE_FOLDER) + "/docs/interface.md");
  std::set<std::string> words;
  for (const char* tool : {"train_model", "detect_poses", "check_poses", "evaluate_poses"})
  {
    const std::string help = run(tool, {"--help"}).out;
    const std::regex option("--[a-z-]+");
    for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found)
      words.insert(found->str());
  }
  DetectionResult result;
  result.poses.emplace_back();
  result.regions.emplace_back();
  const std::string json = toJson(ResultFile{"cam", {}, 0, result});
  const std::regex key("\"([a-z_]+)\":");
  for (std::sregex_iterator found(json.begin(), json.end(), key), end; found != end; ++found)
    words.insert(found->str(1));
  EXPECT_GT(words.size(), 35U);
  for (const std::string& word : words)
    EXPECT_NE(document.find("`" + word + "`"), std::string::npos) << word;
}

TEST_F(CommandLine, refusesBadArguments)
{
  expectRefused("train_model", {}, "--part is required");
  expectRefused("train_model", {"--part", part_}, "--output is required");
  expectRefused("train_model", {"--part", part_, "--output", model_, "--fast"}, "--fast");
  expectRefused("detect_poses", {"--part", part_, "--output", result_}, "no scene given");
  expectRefused("detect_poses", {"--part", part_, "--output", result_, "--depth", depth_},
                "--camera");
  expectRefused("detect_poses", detect({"--cloud", "a.pcd"}), "--cloud");
  expectRefused("detect_poses", detect({"--threads", "-1"}), "--threads");
  expectRefused("detect_poses", detect({"--threads", "two"}), "--threads");
  expectRefused("detect_poses",
                {"--part", part_, "--output", result_, "--cloud", "a.pcd", "--cloud-unit", "cm"},
                "--cloud-unit is 'cm': give m or mm");
  expectRefused("check_poses", {"--part", part_}, "result is required");
}

TEST_F(CommandLine, refusesBadFiles)
{
  expectRefused("train_model", {"--part", "none.yaml", "--output", model_},
                "none.yaml does not exist");
  expectRefused("train_model", {"--part", part_, "--output", folder_.file("none/part.ppf")},
                "cannot be written");
  expectRefused("detect_poses", detect({"--config", folder_.write("c.yaml", "lamda: 1\n")}),
                "unknown key 'lamda': the nearest known name is 'lambda'");
  expectRefused("detect_poses", detect({"--config", folder_.write("c.yaml", "lambda: 1e-1\n")}),
                "lambda is '1e-1'");
  expectRefused("detect_poses", detect({"--roi", folder_.write("r.yaml", "min: [0, 0, 0]\n")}),
                "max is missing");
  expectRefused("detect_poses", detect({"--model", mesh_}), "is no model file");
  folder_.write("depth.png", plane().substr(0, 100));
  expectRefused("detect_poses", detect(), "it is cut off");
  folder_.write("depth.png", plane());
  expectRefused("check_poses", {camera_, "--part", part_, "--depth", depth_, "--camera", camera_},
                "is no result of detect_poses");
  ASSERT_EQ(run("detect_poses", detect()).status, 0);
  const std::string other = folder_.write("part/other.yaml", kPart);
  expectRefusal(
      run("check_poses", {result_, "--part", other, "--depth", depth_, "--camera", camera_}),
      "check_poses", "holds poses of the part 'part', not of 'other'");
  std::filesystem::remove(result_);
  folder_.write("part/model.stl", "solid\nendsolid\n");
  expectRefused("detect_poses", detect(), "holds no finite surface");
}

TEST_F(CommandLine, refusesAnOutputThatIsAnInput)
{
  const std::string config = folder_.write("c.yaml", "lambda: 0.5\n");
  ASSERT_EQ(run("train_model", {"--part", part_, "--output", model_}).status, 0);
  const std::vector<std::string> inputs = {part_, mesh_, depth_, camera_, roi_, config, model_};
  const auto contents = [&]
  {
    std::vector<std::string> bytes;
    for (const std::string& input : inputs)
      bytes.push_back(readFile(input, std::size_t{1} << 28));
    return bytes;
  };
  const std::vector<std::string> before = contents();
  const std::vector<std::string> scene = {"--part", part_, "--depth", depth_, "--camera", camera_,
                                          "--roi",  roi_,  "--model", model_, "--config", config};
  for (const std::string& input : inputs)
  {
    std::vector<std::string> arguments = scene;
    arguments.insert(arguments.end(), {"--output", input});
    expectRefused("detect_poses", arguments, "is both an input and the output");
  }
  std::filesystem::create_symlink(mesh_, folder_.file("link.ppf"));
  expectRefused("train_model", {"--part", part_, "--output", folder_.file("link.ppf")},
                "is both an input and the output");
  ASSERT_EQ(run("detect_poses", detect()).status, 0);
  expectRefusal(run("check_poses", {result_, "--part", part_, "--depth", depth_, "--camera",
                                    camera_, "--image", result_}),
                "check_poses", "is both an input and the output");
  EXPECT_EQ(contents(), before);
}

TEST_F(CommandLine, warnsWithoutARegion)
{
  expectHolds(run("detect_poses", detect()).err, "warning: no region of interest is given");
  const std::string err = run("detect_poses", detect({"--roi", roi_})).err;
  EXPECT_EQ(err.find("warning"), std::string::npos) << err;
}

TEST_F(CommandLine, refusesAModelThatDoesNotFit)
{
  ASSERT_EQ(run("train_model", {"--part", part_, "--output", model_}).status, 0);
  const std::string config = folder_.write("c.yaml", "n_angle: 24\n");
  expectRefused("detect_poses", detect({"--model", model_, "--config", config}), "n_angle");
  folder_.write("part/part.yaml", "unit: mm\ndetector: {step_rel: 0.1}\n");
  expectRefused("detect_poses", detect({"--model", model_}), "was trained from another mesh than");
  folder_.write("part/part.yaml", std::string(kPart) + "symmetries_discrete: []\n");
  expectRefused("detect_poses", detect({"--model", model_}), "with other symmetries than");
}

TEST_F(CommandLine, refusesAPartLargerThanTheRegion)
{
  const std::string small = folder_.write("r.yaml", "{min: [0, 0, 1], max: [0.1, 0.1, 1.1]}");
  const Outcome outcome = run("detect_poses", detect({"--roi", small}));
  EXPECT_EQ(outcome.status, kBadInput);
  expectHolds(outcome.err, "the mesh's unit is probably wrong");
}
}  // namespace
}  // namespace ppf_bin_picking

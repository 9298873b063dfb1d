#include "evaluation_files.hpp"
#include "support/files.hpp"
#include "support/pose_json.hpp"
#include "support/program.hpp"
#include "support/small_png.hpp"
#include "support/stl_text.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace ppf_bin_picking
{
namespace
{
using nlohmann::json;
const char* const kCamera =
    "{width: 64, height: 48, fx: 60.0, fy: 60.0, cx: 31.5, cy: 23.5, depth_unit_m: 0.001, "
    "frame_id: cam}";

Eigen::Isometry3d at(double x, double y = 0)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 6));
}

/// A data set of one part, a tetrahedron of a diameter of 1.414 m, in two scenes.
class EvaluatePoses : public testing::Test
{
protected:
  EvaluatePoses()
  {
    folder_.write("data/tetra/part.yaml", "unit: m\n");
    folder_.write("data/tetra/model.stl", binaryStl(tetrahedron(), 4));
    for (const std::string scene : {"scene-1", "scene-2"})
    {
      const std::string folder = "data/tetra/" + scene;
      folder_.write(folder + "/depth.png", pngOf(std::vector<std::uint16_t>(64 * 48, 7000), 64));
      folder_.write(folder + "/camera.yaml", kCamera);
      folder_.write(folder + "/gt.json", truth_.dump());
      writeResult(scene, good_);
    }
    std::filesystem::create_directories(folder_.file("data/notes"));  // no part: passed over
  }

  void writeResult(const std::string& scene, const json& result) const
  {
    folder_.write("results/tetra/" + scene + ".json", result.dump());
  }

  Outcome evaluate(const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> all = {folder_.file("data"), folder_.file("results"), "--json", json_};
    all.insert(all.end(), more.begin(), more.end());
    return runBuiltTool("evaluate_poses", all, folder_);
  }

  /// What it wrote.
  json evaluation() const { return json::parse(contentOf(json_)); }

  void expectRefused(const std::string& part) const
  {
    expectRefusal(evaluate(), "evaluate_poses", part);
    EXPECT_FALSE(std::filesystem::exists(json_));
  }

  /// Expects a sentence for a result that has been changed.
  void expectBadResult(const std::function<void(json&)>& change, const std::string& part) const
  {
    json result = good_;
    change(result);
    const std::string path = folder_.write("bad.json", result.dump());
    expectHolds(inputError([&] { loadFoundPoses(path); }),
                "bad.json is no result of a detection (" + part);
  }

  void expectBadTruth(const std::function<void(json&)>& change, const std::string& part) const
  {
    json truth = truth_;
    change(truth);
    const std::string path = folder_.write("bad.json", truth.dump());
    expectHolds(inputError([&] { loadTruth(path); }), "bad.json is no ground truth (" + part);
  }

  TemporaryFolder folder_;
  const std::string json_ = folder_.file("evaluation.json");
  const json truth_ = {
      {"objects",
       {trueObject(at(-1.5), 1), trueObject(at(0.5), 0.6), trueObject(at(0.5, -1.5), 0.2)}},
      {"bin", json::object()}};
  const json good_ = {{"time_ms", 12.5},
                      {"poses",
                       {foundPose(at(-1.5), 0.9, true), foundPose(at(0.5, -1.5), 0.8, true),
                        foundPose(at(0.5), 0.7, false), foundPose(at(-0.5, 1), 0.6, true)}}};
};

TEST_F(EvaluatePoses, printsAndWritesTheFigures)
{
  const Outcome outcome = evaluate();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3) << outcome.out;
  expectHolds(outcome.out, "\ntetra ");
  expectHolds(outcome.out, "\nALL ");
  const json all = evaluation();
  for (const char* row : {"tetra", "ALL"})
  {
    const json& figures = all["summary"][row];
    EXPECT_EQ(figures["scenes"], 2);
    EXPECT_EQ(figures["targets"], 4);
    EXPECT_EQ(figures["AP"], 1.0);
    EXPECT_EQ(figures["precision"], 0.5);
    EXPECT_EQ(figures["recall"], 0.5);
    EXPECT_EQ(figures["flag_precision"], 0.0);
    EXPECT_EQ(figures["flag_recall"], 0.0);
    EXPECT_EQ(figures["lost"], 0.5);
    EXPECT_EQ(figures["ms"], 12.5);
    EXPECT_EQ(figures["AR_vsd"], 0.5);
    EXPECT_EQ(figures["AR_mssd"], 0.5);
    EXPECT_EQ(figures["AR_mspd"], 0.5);
    EXPECT_EQ(all["curves"][row].size(), 6U);  // two of eight poses are ignored
    EXPECT_EQ(all["curves"][row][3], json({0.7, 1.0, 1.0}));
  }
}

TEST_F(EvaluatePoses, writesTheVerdictOnEachPose)
{
  ASSERT_EQ(evaluate().status, 0);
  const json scene = evaluation()["scenes"]["tetra"][1];
  EXPECT_EQ(scene["scene"], "scene-2");
  EXPECT_EQ(scene["targets"], 2);
  EXPECT_EQ(scene["recalled"]["vsd"], 1.0);
  std::vector<std::string> verdicts;
  std::vector<int> objects;
  for (const json& pose : scene["poses"])
  {
    verdicts.push_back(pose["verdict"]);
    objects.push_back(pose["object"]);
  }
  EXPECT_EQ(verdicts, (std::vector<std::string>{"right", "ignored", "right", "wrong"}));
  EXPECT_EQ(objects[1], 2);
  EXPECT_EQ(scene["poses"][0]["mssd_rel"], 0.0);
  EXPECT_NEAR(scene["poses"][3]["mssd_rel"], 1.0, 1e-6);  // 1 m aside and 1 m down, of 1.414 m
}

TEST_F(EvaluatePoses, takesThresholdAndVisibility)
{
  ASSERT_EQ(evaluate({"--min-visibility", "0.2", "--threshold", "1.0"}).status, 0);
  EXPECT_EQ(evaluation()["summary"]["ALL"]["targets"], 6);
  EXPECT_EQ(evaluation()["min_visibility"], 0.2);
  EXPECT_EQ(evaluation()["threshold"], 1.0);
}

TEST_F(EvaluatePoses, countsAMissingResultAsNothingFound)
{
  std::filesystem::remove(folder_.file("results/tetra/scene-1.json"));
  const Outcome outcome = evaluate();
  EXPECT_EQ(outcome.status, 0);
  expectHolds(outcome.err, "missing result, counted as nothing found: ");
  EXPECT_EQ(evaluation()["summary"]["ALL"]["recall"], 0.25);
  EXPECT_EQ(evaluation()["summary"]["ALL"]["first"], 0.5);
  EXPECT_TRUE(evaluation()["scenes"]["tetra"][0]["time_ms"].is_null());
}

TEST_F(EvaluatePoses, takesAResultWithoutPoses)
{
  for (const char* scene : {"scene-1", "scene-2"})
    writeResult(scene, {{"poses", json::array()}, {"time_ms", 1}});
  const Outcome outcome = evaluate();
  EXPECT_EQ(outcome.status, 0);
  expectHolds(outcome.out, "nan");
  const json figures = evaluation()["summary"]["ALL"];
  EXPECT_EQ(figures["AP"], 0.0);
  EXPECT_TRUE(figures["precision"].is_null());
}

TEST_F(EvaluatePoses, explainsItself)
{
  const Outcome outcome = runBuiltTool("evaluate_poses", {"--help"}, folder_);
  EXPECT_EQ(outcome.status, 0);
  for (const char* word : {"--threshold", "--min-visibility", "--json", "flagP", "VSD"})
    expectHolds(outcome.out, word);
}

TEST_F(EvaluatePoses, refusesBadArguments)
{
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part)
  { expectRefusal(runBuiltTool("evaluate_poses", arguments, folder_), "evaluate_poses", part); };
  const std::string data = folder_.file("data");
  const std::string results = folder_.file("results");
  refused({}, "is required");
  refused({data}, "results is required");
  refused({data, results, "--threshold", "0"}, "--threshold");
  refused({data, results, "--min-visibility", "2"}, "--min-visibility");
  refused({data, results, "--min-visibility", "nan"}, "nan is no number from 0 to 1");
  refused({data, results, "--threshold", "nan"}, "nan is no number from 0.000001 to 1");
  refused({data, results, "--json", folder_.file("none/a.json")}, "cannot be written");
  refused({folder_.file("none"), results}, "is no folder that can be read");
  refused({results, results}, "holds no <part>/part.yaml");
  refused({data, data}, "holds no <part>/<scene>.json");
}

TEST_F(EvaluatePoses, refusesBadResults)
{
  expectBadResult([](json& r) { r["poses"][2]["pose"].push_back(0); },
                  "'pose' of pose 2 is not 16 numbers");
  expectBadResult([](json& r) { r["poses"][2]["pose"].erase(3); },
                  "'pose' of pose 2 is not 16 numbers");
  expectBadResult([](json& r) { r["poses"][1]["pose"][5] = nullptr; },
                  "'pose' of pose 1 is not 16 numbers");
  expectBadResult([](json& r) { r["poses"][1].erase("pose"); },
                  "'pose' of pose 1 is not 16 numbers");
  expectBadResult([](json& r) { r["poses"][0]["score"] = "high"; }, "pose 0 has no number 'score'");
  expectBadResult([](json& r) { r["poses"][0].erase("score"); }, "pose 0 has no number 'score'");
  expectBadResult([](json& r) { r["poses"][3]["reliable"] = 1; },
                  "pose 3 does not say true or false for 'reliable'");
  expectBadResult([](json& r) { r["poses"][3] = 7; }, "pose 3 is not an object");
  expectBadResult([](json& r) { r["poses"] = 7; }, "'poses' is not a list");
  expectBadResult([](json& r) { r.erase("poses"); }, "'poses' is not a list");
  expectBadResult([](json& r) { r.erase("time_ms"); }, "it has no number 'time_ms'");
  expectBadResult([](json& r) { r = json::array(); }, "'poses' is not a list");
}

TEST_F(EvaluatePoses, refusesWhatIsNoJson)
{
  const std::string text = good_.dump();
  const auto refused = [&](const std::string& content)
  {
    folder_.write("results/tetra/scene-2.json", content);
    expectRefused("scene-2.json is no result of a detection (");
  };
  refused("");
  refused("poses: []\n");
  refused(text.substr(0, text.size() / 2));
  std::string not_a_number = text;
  not_a_number.replace(not_a_number.find("0.9"), 3, "NaN");
  refused(not_a_number);
  std::string too_large = text;
  too_large.replace(too_large.find("0.9"), 3, "1e999");
  refused(too_large);
  refused(std::string("\x89PNG\r\n\x1a\n\0\0", 10));
}

TEST_F(EvaluatePoses, refusesBadTruth)
{
  expectBadTruth([](json& t) { t["objects"][1]["pose"].erase(0); },
                 "'pose' of object 1 is not 16 numbers");
  expectBadTruth([](json& t) { t["objects"][1]["pose"][0] = 2; },
                 "'pose' of object 1 is no rigid transformation");
  expectBadTruth([](json& t) { t["objects"][0].erase("visibility"); },
                 "object 0 has no number 'visibility'");
  expectBadTruth([](json& t) { t.erase("objects"); }, "'objects' is not a list");
}

TEST_F(EvaluatePoses, refusesABadDataSet)
{
  folder_.write("data/tetra/scene-2/gt.json", "{\"objects\": [NaN]}");
  expectRefused("gt.json is no ground truth (");
  folder_.write("data/tetra/scene-2/gt.json", truth_.dump());
  std::filesystem::remove(folder_.file("data/tetra/scene-2/depth.png"));
  expectRefused("depth.png does not exist");
  folder_.write("data/tetra/scene-2/depth.png", pngOf(std::vector<std::uint16_t>(64, 7000), 8));
  expectRefused("has 8 x 8 pixels but its camera file says");
  std::filesystem::remove(folder_.file("data/tetra/scene-2/camera.yaml"));
  expectRefused("camera.yaml does not exist");
  std::filesystem::remove(folder_.file("data/tetra/model.stl"));
  expectRefused("model.stl does not exist");
  folder_.write("data/tetra/model.stl", "solid\nendsolid\n");
  expectRefused("holds no finite surface");
  folder_.write("data/tetra/part.yaml", "unit: cm\n");
  expectRefused("unit is 'cm'");
}

TEST_F(EvaluatePoses, refusesAnOutputThatIsAnInput)
{
  for (const std::string input : {"data/tetra/part.yaml", "data/tetra/model.stl",
                                  "data/tetra/scene-2/gt.json", "results/tetra/scene-1.json"})
  {
    const std::string before = contentOf(folder_.file(input));
    expectRefusal(
        runBuiltTool("evaluate_poses",
                     {folder_.file("data"), folder_.file("results"), "--json", folder_.file(input)},
                     folder_),
        "evaluate_poses", "is both an input and the output");
    EXPECT_EQ(contentOf(folder_.file(input)), before);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

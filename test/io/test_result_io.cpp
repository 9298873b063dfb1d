#include "ppf_bin_picking/io/result_io.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ppf_bin_picking
{
namespace
{
using nlohmann::json;

ResultFile example()
{
  ResultFile file;
  file.frame_id = "camera_optical";
  file.train_seconds = 0.25;
  DetectionResult& result = file.result;
  file.model_id = "bracket";
  result.status = DetectionStatus::kOk;
  result.message = "1 reliable pose";
  result.roi_points = 4711;
  result.noise_m = 0.0002;
  result.seconds = 0.5;
  result.stages = {{"voting", 0.3}, {"clustering", 0.2}};
  DetectedPose pose;
  pose.T_cloud_model = Eigen::Translation3d(0.1, -0.2, 0.5) *
                       Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  pose.score = 0.9;
  pose.votes = 123.5;
  pose.visible_fraction = 0.75;
  pose.rms_error_m = 0.0003;
  pose.looked_through = 0.07;
  pose.usual_looked_through = 0.05;
  pose.pierced = 0.2;
  pose.usual_pierced = 0.1;
  pose.reliable = true;
  result.poses.push_back(pose);
  pose.reliable = false;
  pose.reason = UnreliableReason::kSpread;
  result.poses.push_back(pose);
  MismatchingRegion region;
  region.reason = UnreliableReason::kSpread;
  region.box.T_cloud_box = pose.T_cloud_model;
  region.box.size = {0.3, 0.2, 0.1};
  region.hypotheses = 42;
  region.reliability = 0.25;
  region.detail = "slides";
  result.regions.push_back(region);
  return file;
}

std::string errorOf(const std::string& text)
{
  const TemporaryFolder folder;
  return inputError([&] { loadResult(folder.write("result.json", text)); });
}

TEST(Result, hasTheFieldsThatOthersReadFromIt)
{
  const json root = json::parse(toJson(example()));
  EXPECT_EQ(root["frame_id"], "camera_optical");
  EXPECT_EQ(root["model_id"], "bracket");
  EXPECT_EQ(root["status"], "OK");
  EXPECT_EQ(root["time_ms"], 500.0);
  EXPECT_EQ(root["train_ms"], 250.0);
  EXPECT_EQ(root["roi_points"], 4711);
  EXPECT_EQ(root["noise_m"], 0.0002);
  EXPECT_EQ(root["stages_ms"]["voting"], 300.0);
  ASSERT_EQ(root["poses"].size(), 2U);
  const json& pose = root["poses"][1];
  ASSERT_EQ(pose["pose"].size(), 16U);
  EXPECT_EQ(pose["pose"][3], 0.1);  // row-major
  EXPECT_EQ(pose["pose"][7], -0.2);
  EXPECT_EQ(pose["pose"][15], 1.0);
  EXPECT_EQ(pose["score"], 0.9);
  EXPECT_EQ(pose["votes"], 123.5);
  EXPECT_EQ(pose["reliable"], false);
  EXPECT_EQ(pose["reason"], "SPREAD");
  EXPECT_EQ(root["poses"][0]["reason"], "");
  EXPECT_EQ(pose["visible_fraction"], 0.75);
  EXPECT_EQ(pose["rms_error"], 0.0003);
  EXPECT_EQ(pose["usual_looked_through"], 0.05);
  EXPECT_EQ(pose["usual_pierced"], 0.1);
  ASSERT_EQ(root["regions"].size(), 1U);
  EXPECT_EQ(root["regions"][0]["size"], (std::vector<double>{0.3, 0.2, 0.1}));
  EXPECT_EQ(root["regions"][0]["reason"], "SPREAD");
  EXPECT_EQ(root["regions"][0]["hypotheses"], 42);
  EXPECT_EQ(root["regions"][0]["reliability"], 0.25);
}

TEST(Result, isReadBackAsWritten)
{
  const TemporaryFolder folder;
  const std::string text = toJson(example());
  const ResultFile read = loadResult(folder.write("result.json", text));
  ResultFile again = read;
  EXPECT_EQ(again.result.poses.size(), 2U);
  EXPECT_EQ(again.result.poses[0].T_cloud_model.matrix(),
            example().result.poses[0].T_cloud_model.matrix());
  EXPECT_EQ(toJson(again), text);
}

TEST(Result, isWrittenForEveryStatusAndWithoutPoses)
{
  const TemporaryFolder folder;
  for (const DetectionStatus status :
       {DetectionStatus::kOk, DetectionStatus::kNoPickablePose, DetectionStatus::kRoiEmpty,
        DetectionStatus::kTimeLimit, DetectionStatus::kBadCloud})
  {
    ResultFile file;
    file.result.status = status;
    EXPECT_EQ(loadResult(folder.write("result.json", toJson(file))).result.status, status);
  }
}

TEST(Result, isWrittenWhateverBytesItsTextsHold)
{
  ResultFile file = example();
  file.frame_id = "caf\xe9 \"\n";
  EXPECT_FALSE(json::parse(toJson(file))["frame_id"].get<std::string>().empty());
}

TEST(Result, isRefusedIfItIsNoResult)
{
  for (const char* text : {"", "{", "[]", "{}", "5", "{\"poses\": 3}"})
    expectHolds(errorOf(text), "result.json is no result of detect_poses (");
  json root = json::parse(toJson(example()));
  root["poses"][0]["pose"][0] = 3.0;
  expectHolds(errorOf(root.dump()), "pose is not 16 numbers of a rigid transformation");
  root = json::parse(toJson(example()));
  root["poses"][0]["pose"].erase(3);
  expectHolds(errorOf(root.dump()), "pose is not 16 numbers of a rigid transformation");
  root = json::parse(toJson(example()));
  root["poses"][0]["reliable"] = "yes";
  expectHolds(errorOf(root.dump()), "result.json is no result");
  root = json::parse(toJson(example()));
  root["status"] = "FINE";
  expectHolds(errorOf(root.dump()), "'FINE' is no word of such a file");
}
}  // namespace
}  // namespace ppf_bin_picking

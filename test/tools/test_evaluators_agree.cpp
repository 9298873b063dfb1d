/// @file evaluate_poses against another program of the same metric, on the simulated bins.
#include "ppf_bin_picking/io/part_io.hpp"

#include "evaluation_files.hpp"
#include "support/files.hpp"
#include "support/pose_json.hpp"
#include "support/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
using nlohmann::json;
constexpr double kSame = 1e-6;
constexpr double kSameAngle_deg = 1e-5;  // an arc cosine near 1 loses half of the digits
const char* const kPython = "/usr/bin/python3";

/// JSON of a program that writes NaN.
json parsed(std::string text)
{
  for (std::size_t at = text.find(": NaN"); at != std::string::npos; at = text.find(": NaN"))
    text.replace(at, 5, ": null");
  return json::parse(text);
}

void expectSame(const json& ours, const json& other, double tolerance, const std::string& what)
{
  SCOPED_TRACE(what);
  ASSERT_EQ(ours.is_null(), other.is_null());
  if (ours.is_null()) return;
  EXPECT_NEAR(ours.get<double>(), other.get<double>(), tolerance);
}

void expectSamePoses(const json& ours, const json& other)
{
  ASSERT_EQ(ours.size(), other.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    SCOPED_TRACE(i);
    EXPECT_EQ(ours[i]["verdict"], other[i]["kind"]);
    EXPECT_EQ(ours[i]["score"], other[i]["score"]);
    EXPECT_EQ(ours[i]["reliable"], other[i]["reliable"]);
    if (other[i]["t"].is_null()) continue;  // on no object
    expectSame(ours[i]["t_mm"], other[i]["t"], kSame, "t");
    expectSame(ours[i]["r_deg"], other[i]["r"], kSameAngle_deg, "r");
  }
}

/// Makes results from the truth, with everything that a detector may do.
class ResultMaker
{
public:
  ResultMaker(const PartFolder& folder, unsigned int seed)
      : symmetries_(loadPart(folder.path + "/part.yaml").symmetries()),
        diameter_m_(loadJudgedPart(folder).errors.diameter()),
        rng_(seed)
  {
  }

  /// The truth in random order, each object turned by a random symmetry.
  json truthItself(const std::vector<TrueObject>& objects)
  {
    json poses = json::array();
    for (const TrueObject& object : objects)
      poses.push_back(foundPose(turned(object.T_camera_model), share(), true));
    std::shuffle(poses.begin(), poses.end(), rng_);
    return {{"poses", poses}, {"time_ms", 7}};
  }

  json detection(const std::vector<TrueObject>& objects)
  {
    json poses = json::array();
    const auto add = [&](const Eigen::Isometry3d& pose)
    { poses.push_back(foundPose(pose, std::round(share() * 20) / 20, share() < 0.6)); };  // ties
    for (const TrueObject& object : objects)
    {
      if (share() < 0.15) continue;
      add(moved(turned(object.T_camera_model)));
      if (share() < 0.2) add(moved(turned(object.T_camera_model)));
      if (share() < 0.2) add(randomTurn(object.T_camera_model));
    }
    if (share() < 0.5) poses.push_back(notRigid());
    std::shuffle(poses.begin(), poses.end(), rng_);
    if (share() < 0.1) poses = json::array();
    return {{"poses", poses}, {"time_ms", std::round(100 * share())}};
  }

private:
  double share() { return std::uniform_real_distribution<double>(0, 1)(rng_); }
  Eigen::Vector3d direction()
  {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(rng_), normal(rng_), normal(rng_)).normalized();
  }

  Eigen::Isometry3d turned(const Eigen::Isometry3d& truth)
  {
    const auto& motions = symmetries_.motions();
    Eigen::Isometry3d pose = truth * motions[rng_() % motions.size()];
    if (symmetries_.revolution())
      pose = pose * Eigen::Translation3d(symmetries_.revolution()->point) *
             Eigen::AngleAxisd(2 * M_PI * share(), symmetries_.revolution()->axis) *
             Eigen::Translation3d(-symmetries_.revolution()->point);
    return pose;
  }

  /// Off by up to a sixth of the diameter, mostly by little, and by a few degrees.
  Eigen::Isometry3d moved(const Eigen::Isometry3d& pose)
  {
    const double reach = share();
    Eigen::Isometry3d off = pose;
    off.translation() += diameter_m_ / 6 * reach * reach * direction();
    off.rotate(Eigen::AngleAxisd(0.1 * share() * share(), direction()));
    return off;
  }

  Eigen::Isometry3d randomTurn(const Eigen::Isometry3d& pose)
  {
    Eigen::Isometry3d off = pose;
    off.rotate(Eigen::AngleAxisd(M_PI * share(), direction()));
    return off;
  }

  static json notRigid()
  {
    Eigen::Isometry3d scaled = Eigen::Isometry3d::Identity();
    scaled.linear() *= 1.1;
    return foundPose(scaled, 0.5, true);
  }

  SymmetryGroup symmetries_;
  double diameter_m_;
  std::mt19937 rng_;
};

class Evaluators : public testing::Test
{
protected:
  /// Writes a result of every scene, made by a member function of the maker.
  void writeResults(json (ResultMaker::*make)(const std::vector<TrueObject>&)) const
  {
    unsigned int seed = 1;
    for (const PartFolder& part : listDataset(bins_))
    {
      ResultMaker maker(part, seed++);
      for (const std::string& scene : part.scenes)
        writeResult(part.name, scene,
                    (maker.*make)(loadTruth(part.path + "/" + scene + "/gt.json")));
    }
  }

  void writeResult(const std::string& part, const std::string& scene, const json& result) const
  {
    folder_.write("results/" + part + "/" + scene + ".json", result.dump());
  }

  json ours(const std::vector<std::string>& options) const
  {
    const std::vector<std::string> arguments = with(options, "ours.json");
    const Outcome outcome = runBuiltTool("evaluate_poses", arguments, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(contentOf(folder_.file("ours.json")));
  }

  json other(const std::vector<std::string>& options) const
  {
    std::vector<std::string> arguments = with(options, "other.json");
    arguments.insert(arguments.begin(), dataFile("../tools/evaluate_poses.py"));
    const Outcome outcome = runProgram(kPython, arguments, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return parsed(contentOf(folder_.file("other.json")));
  }

  /// Compares every figure of every row, and the verdict on every pose.
  /// @return What ours says.
  json expectAgreement(const std::vector<std::string>& options = {}) const
  {
    json mine = ours(options);
    const json theirs = other(options);
    EXPECT_EQ(theirs["summary"].size(), 10U);  // nine parts, and all
    EXPECT_EQ(mine["summary"].size(), 10U);
    for (const auto& row : theirs["summary"].items())
      for (const auto& figure : row.value().items())
        expectSame(mine["summary"][row.key()].at(figure.key()), figure.value(), kSame,
                   row.key() + " " + figure.key());
    for (const auto& part : theirs["scenes"].items())
    {
      for (std::size_t i = 0; i < part.value().size(); ++i)
      {
        const json& scene = mine["scenes"][part.key()][i];
        SCOPED_TRACE(part.key() + " " + scene["scene"].get<std::string>());
        EXPECT_EQ(scene["scene"], part.value()[i]["scene"]);
        EXPECT_EQ(scene["targets"], part.value()[i]["targets"]);
        expectSamePoses(scene["poses"], part.value()[i]["rows"]);
      }
    }
    return mine;
  }

  TemporaryFolder folder_;
  const std::string bins_ = dataFile("bins");

private:
  std::vector<std::string> with(std::vector<std::string> options, const std::string& file) const
  {
    options.insert(options.begin(), {bins_, folder_.file("results"), "--json", folder_.file(file)});
    return options;
  }
};

TEST_F(Evaluators, agreeOnMadeUpResults)
{
  writeResults(&ResultMaker::detection);
  std::filesystem::remove(folder_.file("results/cam/scene-2.json"));  // a missing one
  const json figures = expectAgreement()["summary"]["ALL"];  // not all right and not all wrong
  for (const char* name : {"AP", "AP_rel", "precision", "recall", "first", "flag_precision",
                           "flag_recall", "lost", "AR_vsd", "AR_mssd", "AR_mspd"})
  {
    EXPECT_GT(figures[name], 0.1) << name;
    EXPECT_LT(figures[name], 0.9) << name;
  }
}

TEST_F(Evaluators, agreeUnderOtherRules)
{
  writeResults(&ResultMaker::detection);
  expectAgreement({"--threshold", "0.04", "--min-visibility", "0.8"});
}

TEST_F(Evaluators, callTheTruthTimesItsSymmetriesRight)
{
  writeResults(&ResultMaker::truthItself);
  const json all = ours({});
  ASSERT_EQ(all["summary"].size(), 10U);
  for (const auto& row : all["summary"].items())
    for (const char* name :
         {"AP", "precision", "recall", "AP_rel", "first", "AR_vsd", "AR_mssd", "AR_mspd"})
      EXPECT_NEAR(row.value()[name], 1.0, 1e-12) << row.key() << " " << name;
}

TEST_F(Evaluators, agreeOnWhatTheDetectorFinds)
{
  for (const std::string part : {"nut", "stepshaft", "zbracket"})
  {
    const std::string scene = bins_ + "/" + part + "/scene-2";
    const Outcome region =
        runProgram(kPython, {dataFile("../tools/roi_of_scene.py"), scene + "/gt.json"}, folder_);
    ASSERT_EQ(region.status, 0) << region.err;
    writeResult(part, "scene-2", json());  // makes the folder
    const Outcome detection = runBuiltTool(
        "detect_poses",
        {"--part", bins_ + "/" + part + "/part.yaml", "--depth", scene + "/depth.png", "--camera",
         scene + "/camera.yaml", "--roi", folder_.write("roi.yaml", region.out), "--output",
         folder_.file("results/" + part + "/scene-2.json")},
        folder_);
    ASSERT_EQ(detection.status, 0) << detection.err;
  }
  expectAgreement();
}
}  // namespace
}  // namespace ppf_bin_picking

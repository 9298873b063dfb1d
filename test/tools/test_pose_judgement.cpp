#include "pose_judgement.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
/// A plate of 60 x 80 mm, 100 mm from corner to corner (it has no thickness), with its half turn.
PoseErrors plateErrors()
{
  std::vector<Eigen::Vector3d> vertices;
  for (const double x : {-0.03, 0.03})
    for (const double y : {-0.04, 0.04})
      vertices.emplace_back(x, y, 0);
  return {vertices, SymmetryGroup({{SymmetryAxis(), M_PI}}, {})};
}
const PoseErrors kErrors = plateErrors();

Eigen::Isometry3d at(double x, double y = 0, double z = 1)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

ScoredPose found(double x, double score, bool reliable = true)
{
  return {at(x), score, reliable};
}

std::vector<std::string> verdicts(const std::vector<JudgedPose>& poses)
{
  std::vector<std::string> words;
  for (const JudgedPose& pose : poses)
    words.emplace_back(toString(pose.verdict));
  return words;
}
using Words = std::vector<std::string>;

/// Three objects 30 cm apart, the last one hardly visible.
const std::vector<TrueObject> kObjects = {{at(0), 1.0}, {at(0.3), 0.5}, {at(0.6), 0.49}};

TEST(Judgement, takesPosesByScoreAndEachObjectOnce)
{
  const auto judged = judgePoses({found(0.002, 0.2), found(0, 0.9, false), found(0.3, 0.5),
                                  found(0.15, 0.99), found(0.3, 0.4)},
                                 kObjects, kErrors, {});
  EXPECT_EQ(verdicts(judged), (Words{"wrong", "right", "right", "duplicate", "duplicate"}));
  const std::vector<std::size_t> order = {3, 1, 2, 4, 0};
  for (std::size_t i = 0; i < order.size(); ++i)
    EXPECT_EQ(judged[i].index, order[i]);
  EXPECT_FALSE(judged[1].reliable);
  EXPECT_EQ(judged[1].score, 0.9);
  EXPECT_EQ(judged[4].object, 0);
  EXPECT_NEAR(judged[4].mssd_rel, 0.02, 1e-12);
  EXPECT_NEAR(judged[4].translation_m, 0.002, 1e-12);
  EXPECT_NEAR(judged[0].mssd_rel, 1.5, 1e-12);  // halfway between two objects
}

TEST(Judgement, ignoresTheFirstPoseOnAHiddenObject)
{
  const auto judged =
      judgePoses({found(0.6, 0.9), found(0.6, 0.8), found(0.3, 0.7)}, kObjects, kErrors, {});
  EXPECT_EQ(verdicts(judged), (Words{"ignored", "duplicate", "right"}));
  JudgementRules rules;
  rules.min_visibility = 0.49;
  EXPECT_EQ(verdicts(judgePoses({found(0.6, 0.9)}, kObjects, kErrors, rules)), Words{"right"});
}

TEST(Judgement, isStrictAtTheThreshold)
{
  JudgementRules rules;
  rules.threshold_rel = 0.25;
  const auto verdict = [&](double x)
  { return verdicts(judgePoses({found(x, 1)}, kObjects, kErrors, rules)); };
  EXPECT_EQ(verdict(0.0249999), Words{"right"});
  EXPECT_EQ(verdict(0.0250001), Words{"wrong"});
}

TEST(Judgement, keepsTheGivenOrderWhereScoresAreEqual)
{
  const auto judged =
      judgePoses({found(0.004, 0.5), found(0, 0.5), found(0.001, 0.5)}, kObjects, kErrors, {});
  EXPECT_EQ(verdicts(judged), (Words{"right", "duplicate", "duplicate"}));
  EXPECT_EQ(judged[0].index, 0U);
  EXPECT_EQ(judged[1].index, 1U);
}

TEST(Judgement, givesAPoseToTheNearestObjectAlone)
{
  // Two objects 8 mm apart: a pose nearer to the taken one is a duplicate, though it is within the
  // threshold of the free one too.
  const std::vector<TrueObject> close = {{at(0), 1.0}, {at(0.008), 1.0}};
  EXPECT_EQ(verdicts(judgePoses({found(0, 0.9), found(0.003, 0.8), found(0.006, 0.7)}, close,
                                kErrors, {})),
            (Words{"right", "duplicate", "right"}));
}

TEST(Judgement, measuresAgainstTheNearestSymmetry)
{
  ScoredPose turned = found(0, 1);
  turned.T_camera_model.rotate(Eigen::AngleAxisd(M_PI + 0.01, Eigen::Vector3d::UnitZ()));
  const auto judged = judgePoses({turned}, kObjects, kErrors, {});
  EXPECT_EQ(verdicts(judged), Words{"right"});
  EXPECT_NEAR(judged[0].rotation_rad, 0.01, 1e-9);
  EXPECT_NEAR(judged[0].translation_m, 0, 1e-12);
}

TEST(Judgement, measuresErrorsInUnitsOfTheCovariance)
{
  ScoredPose pose = found(0.002, 1);
  EXPECT_TRUE(std::isnan(judgePoses({pose}, kObjects, kErrors, {})[0].nees));
  pose.T_camera_model.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()));
  pose.covariance = Matrix6d::Identity();
  pose.covariance(0, 0) = 0.001 * 0.001;
  pose.covariance(4, 4) = 0.01 * 0.01;
  EXPECT_NEAR(judgePoses({pose}, kObjects, kErrors, {})[0].nees, 4 + 9, 1e-6);
  pose.T_camera_model.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));  // looks the same
  EXPECT_NEAR(judgePoses({pose}, kObjects, kErrors, {})[0].nees, 4 + 9, 1e-6);
}

TEST(Judgement, callsAMatrixThatIsNotRigidWrong)
{
  ScoredPose scaled = found(0, 1);
  scaled.T_camera_model.matrix()(0, 0) = 1.01;
  ScoredPose lost = found(0, 0.9);
  lost.T_camera_model.translation().x() = NAN;
  const auto judged = judgePoses({scaled, lost, found(0, 0.5)}, kObjects, kErrors, {});
  EXPECT_EQ(verdicts(judged), (Words{"wrong", "wrong", "right"}));
  EXPECT_EQ(judged[0].object, -1);
}

TEST(Judgement, needsNeitherPosesNorObjects)
{
  EXPECT_TRUE(judgePoses({}, kObjects, kErrors, {}).empty());
  const auto judged = judgePoses({found(0, 1)}, {}, kErrors, {});
  EXPECT_EQ(verdicts(judged), Words{"wrong"});
  EXPECT_EQ(judged[0].object, -1);
}

TEST(Judgement, doesNotDependOnTheOrderOfPoses)
{
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> place(-0.02, 0.62);
  std::vector<ScoredPose> poses;
  for (int i = 0; i < 60; ++i)
    poses.push_back(found(i % 2 == 0 ? place(rng) : 0.3 * (i % 3), 1.0 / (1 + i)));
  const Words expected = verdicts(judgePoses(poses, kObjects, kErrors, {}));
  for (int trial = 0; trial < 10; ++trial)
  {
    std::shuffle(poses.begin(), poses.end(), rng);
    EXPECT_EQ(verdicts(judgePoses(poses, kObjects, kErrors, {})), expected);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

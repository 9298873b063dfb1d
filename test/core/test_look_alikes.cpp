#include "ppf_bin_picking/core/candidate_verification.hpp"
#include "ppf_bin_picking/core/look_alikes.hpp"

#include "support/shapes.hpp"
#include "support/slow_ray_caster.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// A channel: a web of 80 x 36 x 4 mm and two sides of 22 mm on it.
TriangleMesh channelMesh()
{
  return joined({boxMesh({0.08F, 0.036F, 0.004F}),
                 shifted(boxMesh({0.08F, 0.004F, 0.018F}), {0, 0.016F, 0.011F}),
                 shifted(boxMesh({0.08F, 0.004F, 0.018F}), {0, -0.016F, 0.011F})});
}

SymmetryGroup halfTurn(const Eigen::Vector3d& axis)
{
  return SymmetryGroup({{{axis, Eigen::Vector3d::Zero()}, M_PI}}, {});
}

PpfModel finelyTrained(const TriangleMesh& mesh, const SymmetryGroup& symmetries)
{
  ModelParameters fine;
  fine.step_rel = 0.05;
  return PpfModel::train(mesh, symmetries, fine);
}

TEST(LookAlikes, aChannelUpsideDownLooksLikeItself)
{
  const PpfModel model = finelyTrained(channelMesh(), halfTurn({0, 0, 1}));
  ASSERT_EQ(model.lookAlikes().size(), 1U);
  const Eigen::Isometry3f& turn = model.lookAlikes().front();
  EXPECT_NEAR(Eigen::AngleAxisf(turn.linear()).angle(), M_PI, 0.01);
  EXPECT_LT((turn.linear() * Eigen::Vector3f::UnitZ()).z(), -0.999F);
  const Eigen::Vector3f middle(0, 0, 0.009F);
  EXPECT_LT((turn * middle - middle).norm(), 0.001F);
}

TEST(LookAlikes, turnWithTheMesh)
{
  const Eigen::Isometry3d turned = poseOf(1.1, {1, 2, -1}, {0.03, -0.02, 0.05});
  const SymmetryGroup symmetries(
      {{{turned.linear() * Eigen::Vector3d::UnitZ(), turned.translation()}, M_PI}}, {});
  const PpfModel model = finelyTrained(transformed(channelMesh(), turned), symmetries);
  ASSERT_EQ(model.lookAlikes().size(), 1U);
  const Eigen::Isometry3f& turn = model.lookAlikes().front();
  const Eigen::Vector3f up = turned.linear().col(2).cast<float>();
  EXPECT_LT((turn.linear() * up).dot(up), -0.999F);
  const Eigen::Vector3f middle = (turned * Eigen::Vector3d(0, 0, 0.009)).cast<float>();
  EXPECT_LT((turn * middle - middle).norm(), 0.002F);
}

TEST(LookAlikes, symmetriesAndPartsOfTheirOwnShapeHaveNone)
{
  const SymmetryGroup of_box({{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, M_PI},
                              {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}, M_PI}},
                             {});
  EXPECT_TRUE(finelyTrained(boxMesh({0.08F, 0.05F, 0.03F}), of_box).lookAlikes().empty());
  EXPECT_FALSE(finelyTrained(boxMesh({0.08F, 0.05F, 0.03F}), {}).lookAlikes().empty());
  EXPECT_TRUE(finelyTrained(angleMesh(), {}).lookAlikes().empty());
}

class LookAlikesOfStandingPoses : public ::testing::Test
{
protected:
  /// A pose that a hundred pixels confirm.
  void add(const Eigen::Isometry3f& T_camera_model, bool verified)
  {
    Candidate candidate;
    candidate.T_camera_model = T_camera_model;
    candidate.verified = verified;
    candidate.cluster = 3;
    candidate.votes = 7;
    candidate.evidence.confirmed_weight = 100;
    candidates_.push_back(candidate);
  }

  std::vector<Candidate> turned() const
  {
    return lookAlikesOf({&model_}, config_, candidates_, selected_);
  }

  const PpfModel model_ = finelyTrained(channelMesh(), halfTurn({0, 0, 1}));
  const Eigen::Isometry3f pose_ = poseOf(0.7, {1, 1, 0}, {0, 0, 0.5}).cast<float>();
  DetectorConfig config_;
  std::vector<Candidate> candidates_;
  std::vector<SelectedPose> selected_;
};

TEST_F(LookAlikesOfStandingPoses, areAskedForWhereNoneHasCome)
{
  add(pose_, true);
  EXPECT_TRUE(turned().empty()) << "nothing stands";
  selected_.push_back({0, 100, 100});
  ASSERT_EQ(turned().size(), 1U);
  const Candidate candidate = turned().front();
  EXPECT_FALSE(candidate.verified);
  EXPECT_EQ(candidate.cluster, 3);
  EXPECT_EQ(candidate.votes, 7);
  EXPECT_TRUE(candidate.T_camera_model.isApprox(pose_ * model_.lookAlikes().front()));

  add(candidate.T_camera_model, false);
  EXPECT_EQ(turned().size(), 1U) << "what is not verified has not come";
  Eigen::Isometry3f beside = candidate.T_camera_model;
  beside.translation().x() += 0.05F * static_cast<float>(model_.diameter());
  add(beside, true);
  EXPECT_EQ(turned().size(), 1U) << "it may have got stuck there";
  add(candidate.T_camera_model, true);
  EXPECT_TRUE(turned().empty());
}

TEST_F(LookAlikesOfStandingPoses, areNotAskedForAPoseThatScoresTooLittle)
{
  add(pose_, true);
  candidates_.front().evidence.looked_through = 900;
  selected_.push_back({0, 100, 100});
  EXPECT_TRUE(turned().empty());
}
}  // namespace
}  // namespace ppf_bin_picking

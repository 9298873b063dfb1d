#include "ppf_bin_picking/sim/pick_judge.hpp"
#include "ppf_bin_picking/sim/random.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
using Poses = std::vector<Eigen::Isometry3d>;

Eigen::Isometry3d at(const Eigen::Vector3d& place, double angle_rad = 0,
                     const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ())
{
  return Eigen::Translation3d(place) * Eigen::AngleAxisd(angle_rad, axis.normalized());
}

/// A bolt along z: a round head below, a thinner shaft above.
TriangleMesh boltMesh()
{
  constexpr float kOutline[6][2] = {{0, 0},          {0.013F, 0},     {0.013F, 0.01F},
                                    {0.008F, 0.01F}, {0.008F, 0.05F}, {0, 0.05F}};
  return tubeMesh(72, 5,
                  [&](float turn, float rise)
                  {
                    const float angle = 2 * static_cast<float>(M_PI) * turn;
                    const auto& [across, height] = kOutline[std::lround(5 * rise)];
                    return Eigen::Vector3f(across * std::cos(angle), across * std::sin(angle),
                                           height);
                  });
}

const Eigen::Vector3f kBox(0.06F, 0.04F, 0.02F);
const double kBoxDiameter = kBox.cast<double>().norm();

PickJudge boxJudge(const std::vector<DiscreteSymmetry>& symmetries = {})
{
  return {boxMesh(kBox), {symmetries, {}}, {}};
}

TEST(PickJudge, takesThePartThatIsMeant)
{
  const PickJudge judge = boxJudge();
  const Poses parts = {at({0.1, 0, 0.01}), at({0, 0, 0.01})};
  const PickVerdict verdict = judge.judge(at({0.003, 0, 0.014}), parts);
  EXPECT_EQ(verdict.outcome, PickOutcome::kTaken);
  EXPECT_EQ(verdict.part, 1U);
  EXPECT_NEAR(verdict.error_m, 0.005, 1e-9);
  EXPECT_EQ(verdict.message, "part 1 is taken, its surface off by up to 5.0 mm");
}

TEST(PickJudge, allowsATenthOfTheDiameter)
{
  const PickJudge judge = boxJudge();
  EXPECT_NEAR(judge.diameter(), kBoxDiameter, 1e-6);
  const double limit = 0.1 * kBoxDiameter;
  const Poses parts = {at({0, 0, 0.01})};
  EXPECT_EQ(judge.judge(at({0.99 * limit, 0, 0.01}), parts).outcome, PickOutcome::kTaken);
  const PickVerdict off = judge.judge(at({0, 1.01 * limit, 0.01}), parts);
  EXPECT_EQ(off.outcome, PickOutcome::kNoPartThere);
  EXPECT_EQ(off.message,
            "no part lies there: the nearest, part 0, is off by 7.6 mm and 0.0 deg, its surface by "
            "up to 7.6 mm, of which 7.5 are allowed");
  // A turn counts by how far it takes the corners.
  const double reach = kBoxDiameter / 2;  // nearly across the axis, which is short
  const double turn = limit / reach;
  EXPECT_EQ(judge.judge(at({0, 0, 0.01}, 0.95 * turn), parts).outcome, PickOutcome::kTaken);
  EXPECT_EQ(judge.judge(at({0, 0, 0.01}, 1.2 * turn), parts).outcome, PickOutcome::kNoPartThere);
}

TEST(PickJudge, obeysItsRule)
{
  const Poses parts = {at({0, 0, 0.01})};
  const PickJudge strict(boxMesh(kBox), {}, {0.01, 0.002});
  EXPECT_EQ(strict.judge(at({0.0007, 0, 0.01}), parts).outcome, PickOutcome::kTaken);
  EXPECT_EQ(strict.judge(at({0.0008, 0, 0.01}), parts).outcome, PickOutcome::kNoPartThere);
  for (const PickRule rule :
       {PickRule{0, 0.002}, PickRule{1.1, 0.002}, PickRule{0.1, 0}, PickRule{0.1, 0.2},
        PickRule{NAN, 0.002}, PickRule{0.1, NAN}, PickRule{0.1, 0.002, 0}, PickRule{0.1, 0.002, 2}})
    EXPECT_THROW(PickJudge(boxMesh(kBox), {}, rule), std::invalid_argument);
  EXPECT_THROW(PickJudge({}, {}, {}), std::invalid_argument);
}

TEST(PickJudge, findsNothingInAnEmptyBin)
{
  const PickVerdict verdict = boxJudge().judge(at({0, 0, 0}), {});
  EXPECT_EQ(verdict.outcome, PickOutcome::kNoPartThere);
  EXPECT_EQ(verdict.message, "no part lies there: the bin is empty");
}

TEST(PickJudge, takesSymmetricPosesForTheSame)
{
  const Poses parts = {at({0.02, 0.01, 0.01}, 0.4)};
  const Eigen::Isometry3d turned = parts[0] * at({0, 0, 0}, M_PI);
  EXPECT_EQ(boxJudge().judge(turned, parts).outcome, PickOutcome::kNoPartThere);
  const PickJudge symmetric = boxJudge({{{}, M_PI}});
  EXPECT_EQ(symmetric.judge(turned, parts).outcome, PickOutcome::kTaken);
  EXPECT_NEAR(symmetric.judge(turned, parts).error_m, 0, 1e-9);
  EXPECT_EQ(symmetric.judge(parts[0] * at({0, 0, 0}, M_PI, {1, 0, 0}), parts).outcome,
            PickOutcome::kNoPartThere);
}

TEST(PickJudge, knowsAHeadFromATail)
{
  const PickJudge judge(boltMesh(), {{}, {{Eigen::Vector3d::UnitZ(), {0, 0, 0}}}}, {});
  const Poses parts = {at({0, 0, 0.013}, M_PI / 2, {1, 0, 0})};  // lies along -y
  for (const double turn : {0.3, 1.0, 2.2, 4.4})
    EXPECT_EQ(judge.judge(parts[0] * at({0, 0, 0}, turn), parts).outcome, PickOutcome::kTaken);
  const Eigen::Isometry3d end_for_end = at({0, 0, 0.05}, M_PI, {1, 0, 0});
  const PickVerdict verdict = judge.judge(parts[0] * end_for_end, parts);
  EXPECT_EQ(verdict.outcome, PickOutcome::kNoPartThere);
  EXPECT_NE(verdict.message.find("180.0 deg"), std::string::npos) << verdict.message;
}

TEST(PickJudge, doesNotTakeAPartThatAnotherLiesOn)
{
  const PickJudge judge = boxJudge();
  const Poses parts = {at({0, 0, 0.03}), at({0.01, 0, 0.01})};
  EXPECT_EQ(judge.judge(parts[0], parts).outcome, PickOutcome::kTaken);
  const PickVerdict lower = judge.judge(parts[1], parts);
  EXPECT_EQ(lower.outcome, PickOutcome::kCovered);
  EXPECT_EQ(lower.part, 1U);
  EXPECT_EQ(lower.covered_by, 0U);
  EXPECT_EQ(lower.message, "part 1 is meant, but part 0 lies on it");
}

TEST(PickJudge, namesThePartThatCoversMost)
{
  const PickJudge judge = boxJudge();
  const Poses parts = {at({-0.055, 0, 0.03}), at({0, 0, 0.01}), at({0.04, 0, 0.03})};
  EXPECT_EQ(judge.judge(parts[1], parts).covered_by, 2U);
}

/// An L on its short leg, the long one level at 32 to 40 mm; below that another L, 30 mm high.
TEST(PickJudge, seesAPartUnderAnOverhang)
{
  const PickJudge judge(angleMesh(), {}, {});
  const Poses parts = {at({0, 0, 0.04}, M_PI, {1, 0, 0}),
                       at({0.015, 0.02, 0}, M_PI / 2, {1, 0, 0})};
  EXPECT_EQ(judge.judge(parts[0], parts).outcome, PickOutcome::kTaken);
  EXPECT_EQ(judge.judge(parts[1], parts).outcome, PickOutcome::kCovered);
}

/// Boxes along the axes: one is in the way if it would have to be pushed far in length and in
/// width, and is higher than a contact.
TEST(PickJudge, agreesWithWhatBoxesShare)
{
  const PickRule rule;
  const PickJudge judge(boxMesh(kBox), {}, rule);
  const double push_m = rule.push_rel * kBoxDiameter;
  Random random(5);
  int covered = 0;
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    const Eigen::Vector3d place(random.uniform(-0.08, 0.08), random.uniform(-0.06, 0.06),
                                random.uniform(-0.03, 0.03));
    const double aside_m = std::min(kBox.x() - std::abs(place.x()), kBox.y() - std::abs(place.y()));
    const double higher_m = kBox.z() + place.z();
    // The lines stand half a contact apart.
    if (std::abs(aside_m - push_m) < rule.contact_m) continue;
    if (std::abs(higher_m - rule.contact_m) < 1e-5) continue;
    const bool in_the_way = aside_m > push_m && higher_m > rule.contact_m;
    const Poses parts = {at({0, 0, 0.01}), at(place + Eigen::Vector3d(0, 0, 0.01))};
    EXPECT_EQ(judge.judge(parts[0], parts).outcome,
              in_the_way ? PickOutcome::kCovered : PickOutcome::kTaken)
        << place.transpose();
    ++compared;
    if (in_the_way) ++covered;
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(covered, 50);
  EXPECT_LT(covered, compared - 50);
}

TEST(PickJudge, seesAThinPartAcross)
{
  // A sheet on its edge, across the middle of another that lies flat.
  const PickJudge judge(boxMesh({0.06F, 0.04F, 0.0015F}), {}, {});
  const Poses parts = {at({0, 0, 0.00075}), at({0, 0, 0.0215}, M_PI / 2, {1, 0, 0})};
  EXPECT_EQ(judge.judge(parts[0], parts).outcome, PickOutcome::kCovered);
  EXPECT_EQ(judge.judge(parts[1], parts).outcome, PickOutcome::kTaken);
}

/// The whole situation turned about the vertical and shifted gives the same judgement, but for the
/// few that are on the verge.
TEST(PickJudge, doesNotDependOnWhereThePileLies)
{
  const PickJudge judge(bracketMesh(), {}, {});
  Random random(11);
  int differ = 0;
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Isometry3d moved = at({0.2, -0.1, 0.3}, 0.37);
    Poses parts;
    Poses moved_parts;
    for (int part = 0; part < 3; ++part)
    {
      parts.push_back(at(0.05 * random.direction(), random.uniform(0, 3), random.direction()));
      moved_parts.push_back(moved * parts.back());
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const PickVerdict a = judge.judge(parts[i], parts);
      const PickVerdict b = judge.judge(moved_parts[i], moved_parts);
      EXPECT_NEAR(a.error_m, b.error_m, 1e-9);
      if (a.outcome != b.outcome) ++differ;
    }
  }
  EXPECT_LE(differ, 3);
}
}  // namespace
}  // namespace ppf_bin_picking

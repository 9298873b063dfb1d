#include "ppf_bin_picking/core/ppf.hpp"

#include "support/brute_force.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
/// Two points with normals.
struct Pair
{
  Eigen::Vector3f p1, n1, p2, n2;
};

Pair randomPair(std::mt19937& rng)
{
  Pair pair;
  pair.p1 = randomPoint(rng, 0.1F);
  pair.n1 = randomDirection(rng);
  pair.p2 = randomPoint(rng, 0.1F);
  pair.n2 = randomDirection(rng);
  return pair;
}

Pair moved(const Eigen::Isometry3f& T, const Pair& pair)
{
  return {T * pair.p1, T.linear() * pair.n1, T * pair.p2, T.linear() * pair.n2};
}

PairFeature featureOf(const Pair& pair)
{
  return pairFeature(pair.p1, pair.n1, pair.p2, pair.n2);
}

void expectNear(const PairFeature& a, const PairFeature& b, float tolerance)
{
  EXPECT_NEAR(a.distance_m, b.distance_m, tolerance);
  EXPECT_NEAR(a.angle_n1_d_rad, b.angle_n1_d_rad, tolerance);
  EXPECT_NEAR(a.angle_n2_d_rad, b.angle_n2_d_rad, tolerance);
  EXPECT_NEAR(a.angle_n1_n2_rad, b.angle_n1_n2_rad, tolerance);
}

TEST(PairFeature, equalsTheObviousOne)
{
  std::mt19937 rng(1);
  for (int trial = 0; trial < 500; ++trial)
  {
    SCOPED_TRACE(trial);
    const Pair pair = randomPair(rng);
    const PairFeature feature = featureOf(pair);
    const Eigen::Vector3d d = (pair.p2 - pair.p1).cast<double>();
    EXPECT_NEAR(feature.distance_m, d.norm(), 1e-6);
    EXPECT_NEAR(feature.angle_n1_d_rad, slowAngle(pair.n1.cast<double>(), d), 1e-3);
    EXPECT_NEAR(feature.angle_n2_d_rad, slowAngle(pair.n2.cast<double>(), d), 1e-3);
    EXPECT_NEAR(feature.angle_n1_n2_rad, slowAngle(pair.n1.cast<double>(), pair.n2.cast<double>()),
                1e-3);
  }
}

TEST(PairFeature, staysTheSameUnderRigidMotion)
{
  std::mt19937 rng(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    SCOPED_TRACE(trial);
    const Pair pair = randomPair(rng);
    const Eigen::Isometry3f T = randomPose(rng, 0.5).cast<float>();
    expectNear(featureOf(moved(T, pair)), featureOf(pair), 2e-3F);
  }
}

TEST(PairFeature, isDefinedForPointsInOnePlaceAndParallelNormals)
{
  const Eigen::Vector3f p(1, 2, 3), x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY();
  const PairFeature same = pairFeature(p, x, p, y);
  EXPECT_EQ(same.distance_m, 0);
  EXPECT_EQ(same.angle_n1_d_rad, 0);
  EXPECT_EQ(same.angle_n2_d_rad, 0);
  EXPECT_NEAR(same.angle_n1_n2_rad, M_PI_2, 1e-6);
  const Eigen::Vector3f n = Eigen::Vector3f(1, 1, 1) * 0.57735032F;  // a little longer than 1
  EXPECT_EQ(pairFeature(p, n, p + n, n).angle_n1_n2_rad, 0);
  EXPECT_NEAR(pairFeature(p, n, p + n, -n).angle_n1_n2_rad, M_PI, 1e-6);
}

/// Keys over steps of 0.1 of a diameter of 1 m and 12 angle steps: 11 x 6 x 6 x 6 cells.
class FeatureQuantizerTest : public ::testing::Test
{
protected:
  FeatureQuantizer quantizer_ = FeatureQuantizer({0.1, 12}, 1.0F);
};

TEST_F(FeatureQuantizerTest, numbersTheCellsInOrder)
{
  EXPECT_EQ(quantizer_.keyCount(), 11U * 6 * 6 * 6);
  std::uint32_t expected = 0;
  for (int d = 0; d < 10; ++d)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        for (int c = 0; c < 6; ++c)
        {
          const auto middle = [](int bin, double step)
          { return static_cast<float>((bin + 0.5) * step); };
          const PairFeature feature{middle(d, 0.1), middle(a, M_PI / 6), middle(b, M_PI / 6),
                                    middle(c, M_PI / 6)};
          EXPECT_EQ(quantizer_.key(feature), expected++);
        }
}

TEST_F(FeatureQuantizerTest, changesTheCellAtTheBorderOfAStep)
{
  const auto key_at = [&](float distance, float angle) {
    return quantizer_.key({distance, angle, 0, 0});
  };
  EXPECT_EQ(key_at(0.3001F, 0), key_at(0.3999F, 0));
  EXPECT_NE(key_at(0.2999F, 0), key_at(0.3001F, 0));
  const float step = static_cast<float>(M_PI) / 6;
  EXPECT_EQ(key_at(0.1F, step * 1.001F), key_at(0.1F, step * 1.999F));
  EXPECT_NE(key_at(0.1F, step * 0.999F), key_at(0.1F, step * 1.001F));
}

TEST_F(FeatureQuantizerTest, hasACellForTheLargestValues)
{
  const float pi = std::nextafter(static_cast<float>(M_PI), 4.0F);
  EXPECT_LT(quantizer_.key({1.0F, pi, pi, pi}), quantizer_.keyCount());
  EXPECT_TRUE(quantizer_.covers(1.0F));
  EXPECT_FALSE(quantizer_.covers(std::nextafter(1.0F, 2.0F)));
  for (const int n_angle : {8, 9, 31, 119})
    for (const double step_rel : {0.01, 0.03, 0.07, 0.2})
    {
      const FeatureQuantizer quantizer({step_rel, n_angle}, 0.123F);
      EXPECT_LT(quantizer.key({0.123F, pi, pi, pi}), quantizer.keyCount());
    }
}

TEST(RotationToX, turnsAnyNormalOntoX)
{
  std::mt19937 rng(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Vector3f normal = randomDirection(rng);
    const Eigen::Matrix3f rotation = rotationToX(normal);
    EXPECT_LT((rotation * normal - Eigen::Vector3f::UnitX()).norm(), 1e-5F);
    EXPECT_NEAR(rotation.determinant(), 1, 1e-5);
    EXPECT_TRUE(rotation.isUnitary(1e-5F));
    EXPECT_TRUE(rotation == rotationToX(normal));
  }
}

TEST(PairAlpha, bringsTheSecondPointIntoTheHalfPlane)
{
  std::mt19937 rng(4);
  for (int trial = 0; trial < 200; ++trial)
  {
    SCOPED_TRACE(trial);
    const Pair pair = randomPair(rng);
    const Eigen::Matrix3f rotation = rotationToX(pair.n1);
    const double alpha_rad = 2 * M_PI * pairAlpha(rotation, pair.p1, pair.p2) / kAlphaTurn;
    const Eigen::Vector3d local = Eigen::AngleAxisd(alpha_rad, Eigen::Vector3d::UnitX()) *
                                  (rotation * (pair.p2 - pair.p1)).cast<double>();
    EXPECT_GT(local.y(), 0);
    EXPECT_LT(std::abs(local.z()), 2e-4 * local.norm());
  }
}

TEST(PairAlpha, givesThePoseByItsDifference)
{
  std::mt19937 rng(5);
  for (int trial = 0; trial < 200; ++trial)
  {
    SCOPED_TRACE(trial);
    const Pair model = randomPair(rng);
    const Eigen::Isometry3f truth = randomPose(rng, 0.5).cast<float>();
    const Pair scene = moved(truth, model);
    const Eigen::Matrix3f R_local_model = rotationToX(model.n1);
    const Eigen::Matrix3f R_local_scene = rotationToX(scene.n1);
    const auto turn = static_cast<std::uint16_t>(pairAlpha(R_local_model, model.p1, model.p2) -
                                                 pairAlpha(R_local_scene, scene.p1, scene.p2));
    const Eigen::Matrix3f rotation =
        R_local_scene.transpose() *
        Eigen::AngleAxisf(2 * static_cast<float>(M_PI) * turn / kAlphaTurn,
                          Eigen::Vector3f::UnitX())
            .toRotationMatrix() *
        R_local_model;
    EXPECT_LT((rotation * (model.p2 - model.p1) + scene.p1 - scene.p2).norm(), 1e-4F);
    EXPECT_LT((rotation - truth.linear()).norm(), 1e-2F);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

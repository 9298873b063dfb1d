// The vectorised kernels against plain twins; other tests of the core compare what is built on
// them.
#include "ppf_bin_picking/core/alignment.hpp"
#include "ppf_bin_picking/core/boundary_table.hpp"
#include "ppf_bin_picking/core/ppf.hpp"
#include "ppf_bin_picking/core/viewpoints.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
/// Some points of which not all are whole groups of lanes.
struct RandomPoints
{
  explicit RandomPoints(std::size_t count)
  {
    std::mt19937 rng(3);
    for (std::size_t i = 0; i < count; ++i)
    {
      points.push_back(randomPoint(rng, 0.1F));
      normals.push_back(randomDirection(rng));
    }
    points[count / 2] = points[0];
  }
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

TEST(ArcCosine, isThatOfTheLibrary)
{
  for (int i = -1000; i <= 1000; ++i)
    EXPECT_NEAR(arcCosine(static_cast<float>(i) / 1000), std::acos(i / 1000.0), 5e-7);
  EXPECT_EQ(arcCosine(1.0001F), 0);
  EXPECT_FLOAT_EQ(arcCosine(-1.0001F), static_cast<float>(M_PI));
}

TEST(TurnsOf, isTheAngleOfTheLibraryInAllDirections)
{
  for (int degrees = 1; degrees < 360; ++degrees)
  {
    const double angle = degrees * M_PI / 180;
    EXPECT_NEAR(
        turnsOf(static_cast<float>(3 * std::cos(angle)), static_cast<float>(3 * std::sin(angle))),
        degrees / 360.0, 5e-7);
  }
  EXPECT_EQ(turnsOf(1, 0), 0);
  EXPECT_EQ(turnsOf(0, 0), 0);
}

TEST(PairKeys, areThoseOfThePairsOneByOne)
{
  const RandomPoints random(203);
  const FeatureQuantizer quantizer({0.07, 30}, 0.12F);
  PointArrays arrays;
  for (std::size_t i = 0; i < random.points.size(); ++i)
    arrays.add(random.points[i].data(), random.normals[i].data());
  std::vector<std::uint32_t> keys(arrays.size()), alphas(arrays.size());
  const Eigen::Vector3f &p1 = random.points[0], &n1 = random.normals[0];
  pairKeys(arrays, pairReference(p1, n1), quantizer.steps(), keys.data(), alphas.data());
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    SCOPED_TRACE(i);
    const PairFeature feature = pairFeature(p1, n1, random.points[i], random.normals[i]);
    if (feature.distance_m == 0 || !quantizer.covers(feature.distance_m))
    {
      EXPECT_EQ(keys[i], kNoKey);
      continue;
    }
    ++pairs;
    EXPECT_EQ(keys[i], quantizer.key(feature));
    EXPECT_EQ(alphas[i], pairAlpha(rotationToX(n1), p1, random.points[i]));
  }
  EXPECT_GT(pairs, 50U);
  EXPECT_LT(pairs, arrays.size() - 2) << "some are too long, two are in one place";
}

TEST(BoundaryKeys, areThoseOfThePairsOneByOne)
{
  const RandomPoints random(101);
  const BoundaryQuantizer quantizer(0.15F);
  std::vector<BoundaryPoint> boundary;
  BoundaryArrays arrays;
  arrays.resize(random.points.size());
  for (std::size_t i = 0; i < random.points.size(); ++i)
  {
    boundary.push_back({random.points[i], random.normals[i], random.normals[i].unitOrthogonal()});
    arrays.set(i, boundary[i].point.data(), boundary[i].normal.data(), boundary[i].outward.data());
  }
  const BoundaryReference first = boundaryReference(boundary[0]);
  std::vector<std::uint32_t> keys(boundary.size());
  boundaryKeys(arrays, first, quantizer.steps(), keys.data());
  for (std::size_t i = 0; i < boundary.size(); ++i)
    EXPECT_EQ(keys[i], quantizer.key(first, boundary[i])) << i;
  EXPECT_EQ(keys[0], kNoKey);
}

/// A ball before a wall, and samples of the ball around a pose that is a little off. Some fall on
/// the wall, some beside the image.
class SumAlignment : public ::testing::Test
{
protected:
  SumAlignment()
  {
    for (std::size_t i = 0; i < 301; ++i)
    {
      const Eigen::Vector3f direction = evenDirection(static_cast<int>(i), 301);
      samples_.add(Eigen::Vector3f(0.04F * direction).data(), direction.data());
    }
  }

  /// The same, spelt out.
  NormalEquations plainly(const Eigen::Isometry3f& T) const
  {
    NormalEquations equations;
    const Eigen::Vector3f center = Eigen::Map<const Eigen::Vector3f>(terms_.center_m);
    for (std::size_t i = 0; i < samples_.size(); ++i)
    {
      const Eigen::Vector3f p = T * Eigen::Vector3f(samples_.x[i], samples_.y[i], samples_.z[i]);
      const Eigen::Vector3f n =
          T.linear() * Eigen::Vector3f(samples_.nx[i], samples_.ny[i], samples_.nz[i]);
      int u, v;
      if (!image_.camera.pixelOf(p, u, v) || image_.depth[image_.index(u, v)] == 0) continue;
      const Eigen::Vector3f& measured = image_.normals[image_.index(u, v)];
      const float residual = measured.dot(image_.point(u, v) - p);
      const float share = residual / terms_.gate_m;
      if (measured.dot(n) < terms_.min_normal_cosine || std::abs(share) >= 1) continue;
      equations.add(motionJacobian((p - center) / terms_.lever_m, measured), residual,
                    (1 - share * share) * (1 - share * share));
    }
    return equations;
  }

  RangeImage image_ = imageOf({{squareMesh(0.2F), poseOf(M_PI, {1, 0, 0}, {0, 0, 0.6})},
                               {sphereMesh(0.04F), poseOf(0, {0, 0, 1}, {0.005, 0, 0.5})}},
                              0.004F);
  PointArrays samples_;
  AlignmentTerms terms_{{0.005F, 0, 0.5F}, 0.03F, 0.01F, 0.7F};
};

TEST_F(SumAlignment, isTheSumOverTheSamplesOneByOne)
{
  for (const float x : {0.004F, 0.01F, 0.15F, 0.21F})
  {
    SCOPED_TRACE(x);
    const Eigen::Isometry3f T = poseOf(0.3, {1, 2, 3}, {x, 0.001, 0.499}).cast<float>();
    const NormalEquations plain = plainly(T),
                          fast = alignmentOf(samples_, arraysOf(image_), T, terms_);
    if (x < 0.1F)
    {
      EXPECT_GT(plain.weight, 50);
    }
    EXPECT_NEAR(fast.weight, plain.weight, 1e-3F * plain.weight);
    EXPECT_LE((fast.matrix - plain.matrix).norm(), 1e-3F * plain.matrix.norm());
    EXPECT_LE((fast.right_side - plain.right_side).norm(), 1e-3F * plain.right_side.norm());
  }
}

TEST_F(SumAlignment, isNothingBehindTheCamera)
{
  const Eigen::Isometry3f T = poseOf(0, {0, 0, 1}, {0, 0, -0.5}).cast<float>();
  EXPECT_EQ(alignmentOf(samples_, arraysOf(image_), T, terms_).weight, 0);
}
}  // namespace
}  // namespace ppf_bin_picking

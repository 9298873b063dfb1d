#include "ppf_bin_picking/core/pca.hpp"

#include "support/synthetic.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
using Points = std::vector<Eigen::Vector3f>;

Points randomCloud(std::mt19937& rng, std::size_t count, const Eigen::Vector3f& stretch)
{
  Points points(count);
  for (Eigen::Vector3f& point : points)
    point = randomPoint(rng, 1).cwiseProduct(stretch);
  return points;
}

Points moved(const Eigen::Isometry3d& T, Points points)
{
  for (Eigen::Vector3f& point : points)
    point = T.cast<float>() * point;
  return points;
}

/// Variance of the points along a direction.
double varianceAlong(const Points& points, const Eigen::Vector3d& direction)
{
  double sum = 0, squares = 0;
  for (const Eigen::Vector3f& point : points)
  {
    const double along = point.cast<double>().dot(direction);
    sum += along;
    squares += along * along;
  }
  const auto count = static_cast<double>(points.size());
  return squares / count - sum / count * (sum / count);
}

TEST(PrincipalBox, holdsEveryPointAndTouchesOneOnEachSide)
{
  std::mt19937 rng(31);
  for (int trial = 0; trial < 50; ++trial)
  {
    SCOPED_TRACE(trial);
    const Points points = moved(randomPose(rng, 2), randomCloud(rng, 40, {3, 2, 1}));
    const OrientedBox box = principalBox(points);
    Eigen::AlignedBox3d extent;
    for (const Eigen::Vector3f& point : points)
      extent.extend(box.T_cloud_box.inverse() * point.cast<double>());
    EXPECT_LT((extent.max() - box.size / 2).norm(), 1e-5);
    EXPECT_LT((extent.min() + box.size / 2).norm(), 1e-5);
  }
}

TEST(PrincipalBox, hasRightHandedAxesOfFallingVariance)
{
  std::mt19937 rng(32);
  for (int trial = 0; trial < 50; ++trial)
  {
    SCOPED_TRACE(trial);
    const Points points = moved(randomPose(rng, 2), randomCloud(rng, 100, {3, 2, 1}));
    const Eigen::Matrix3d axes = principalBox(points).T_cloud_box.linear();
    EXPECT_TRUE(axes.isUnitary(1e-9));
    EXPECT_NEAR(axes.determinant(), 1, 1e-9);
    const double first = varianceAlong(points, axes.col(0));
    const double second = varianceAlong(points, axes.col(1));
    const double third = varianceAlong(points, axes.col(2));
    EXPECT_GT(first, second);
    EXPECT_GT(second, third);
    for (int k = 0; k < 20; ++k)  // no direction varies more, none less
    {
      const double variance = varianceAlong(points, randomDirection(rng).cast<double>());
      EXPECT_LE(variance, first * (1 + 1e-6));
      EXPECT_GE(variance, third * (1 - 1e-6));
    }
    for (int k = 0; k < 2; ++k)
    {
      Eigen::Index largest = 0;
      axes.col(k).cwiseAbs().maxCoeff(&largest);
      EXPECT_GT(axes(largest, k), 0);
    }
  }
}

TEST(PrincipalBox, keepsItsSizesUnderRigidMotionAndAnyOrder)
{
  std::mt19937 rng(33);
  const Points points = randomCloud(rng, 80, {0.05F, 0.03F, 0.01F});
  const Eigen::Vector3d size = principalBox(points).size;
  for (int trial = 0; trial < 20; ++trial)
  {
    Points other = moved(randomPose(rng, 1), points);
    std::shuffle(other.begin(), other.end(), rng);
    EXPECT_LT((principalBox(other).size - size).norm(), 1e-5);
  }
}

TEST(PrincipalBox, copesWithDegenerateSets)
{
  EXPECT_TRUE(principalBox({}).size.isZero());
  EXPECT_TRUE(principalBox({}).T_cloud_box.isApprox(Eigen::Isometry3d::Identity()));
  const Eigen::Vector3f p(1, 2, 3), q(1, 2, 5);
  const OrientedBox one = principalBox({p});
  EXPECT_TRUE(one.size.isZero());
  EXPECT_TRUE(one.T_cloud_box.translation().isApprox(p.cast<double>()));
  EXPECT_TRUE(principalBox(Points(9, p)).size.isZero(1e-9));
  const OrientedBox line = principalBox({p, q, (p + q) / 2});
  EXPECT_TRUE(line.size.isApprox(Eigen::Vector3d(2, 0, 0), 1e-9));
  EXPECT_NEAR(line.T_cloud_box.linear()(2, 0), 1, 1e-9);
  EXPECT_NEAR(line.T_cloud_box.linear().determinant(), 1, 1e-9);
}

TEST(SideSum, addsTheSides)
{
  OrientedBox box;
  box.size = {3, 2, 0.5};
  EXPECT_DOUBLE_EQ(sideSum(box), 5.5);
}
}  // namespace
}  // namespace ppf_bin_picking

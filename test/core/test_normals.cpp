#include "ppf_bin_picking/core/normals.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr int kRadius_px = 2;
constexpr float kGate_m = 0.005F;
const PinholeCamera kCamera{90, 70, 300, 320, 41.0F, 37.5F};

/// A plane through a point on the optical axis.
struct Plane
{
  Eigen::Vector3d normal;  ///< Unit length, towards the camera.
  double axis_z_m;

  double depthAlong(const Eigen::Vector3f& ray) const
  {
    return normal.z() * axis_z_m / normal.dot(ray.cast<double>());
  }
};

/// Slanted by an angle towards a direction in the image.
Plane slantedPlane(double slant_rad, double towards_rad, double axis_z_m)
{
  return {Eigen::Vector3d(std::sin(slant_rad) * std::cos(towards_rad),
                          std::sin(slant_rad) * std::sin(towards_rad), -std::cos(slant_rad)),
          axis_z_m};
}

/// The image of what lies at a depth of each pixel [m]; 0: not measured.
RangeImage imageOf(const std::function<double(int, int)>& depth)
{
  RangeImage image;
  image.camera = kCamera;
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u)
      image.depth.push_back(static_cast<float>(depth(u, v)));
  image.in_roi.assign(image.depth.size(), 1);
  return image;
}

Eigen::Vector3f rayOf(int u, int v)
{
  return kCamera.ray(static_cast<float>(u), static_cast<float>(v));
}

double angleTo(const Eigen::Vector3f& normal, const Eigen::Vector3d& truth)
{
  return std::atan2(normal.cast<double>().cross(truth).norm(), normal.cast<double>().dot(truth));
}

TEST(EstimateImageNormals, isExactForPlanesAtAnySlant)
{
  for (const double slant_rad : {0.0, 0.3, 0.7, 1.1})
    for (const double towards_rad : {0.0, 1.0, 2.5, 4.0})
    {
      SCOPED_TRACE(::testing::Message() << slant_rad << " " << towards_rad);
      const Plane plane = slantedPlane(slant_rad, towards_rad, 0.6);
      RangeImage image = imageOf([&](int u, int v) { return plane.depthAlong(rayOf(u, v)); });
      estimateImageNormals(image, kRadius_px, 0.03F, 1);
      double worst_rad = 0;
      for (const Eigen::Vector3f& normal : image.normals)
      {
        ASSERT_NEAR(normal.norm(), 1, 1e-5);
        worst_rad = std::max(worst_rad, angleTo(normal, plane.normal));
      }
      EXPECT_LT(worst_rad, 1e-3) << "borders of the image included";
    }
}

TEST(EstimateImageNormals, isExactWhereNeighboursAreMissing)
{
  const Plane plane = slantedPlane(0.6, 1.0, 0.6);
  std::mt19937 rng(3);
  RangeImage image =
      imageOf([&](int u, int v) { return rng() % 3 == 0 ? 0.0 : plane.depthAlong(rayOf(u, v)); });
  estimateImageNormals(image, kRadius_px, kGate_m, 1);
  int known = 0;
  for (std::size_t i = 0; i < image.normals.size(); ++i)
  {
    if (image.depth[i] == 0)
    {
      EXPECT_TRUE(image.normals[i].isZero()) << "nothing measured, no normal";
    }
    if (image.normals[i].isZero()) continue;
    ++known;
    EXPECT_LT(angleTo(image.normals[i], plane.normal), 2e-3);
  }
  EXPECT_GT(known, 0.6 * static_cast<double>(image.normals.size()));
}

TEST(EstimateImageNormals, isUnknownWithTooFewNeighboursOrAllInALine)
{
  const auto spots = [](int u, int v) { return u % 10 < 2 && v % 10 < 2 ? 0.6 : 0.0; };
  RangeImage image = imageOf(spots);
  estimateImageNormals(image, kRadius_px, kGate_m, 1);
  EXPECT_TRUE(std::all_of(image.normals.begin(), image.normals.end(),
                          [](const Eigen::Vector3f& n) { return n.isZero(); }));
  RangeImage lines = imageOf([](int, int v) { return v % 10 == 0 ? 0.6 : 0.0; });
  estimateImageNormals(lines, 5, kGate_m, 1);  // 11 neighbours each
  EXPECT_TRUE(std::all_of(lines.normals.begin(), lines.normals.end(),
                          [](const Eigen::Vector3f& n) { return n.isZero(); }));
}

TEST(EstimateImageNormals, doesNotMixSurfacesAtAStep)
{
  for (const double slant_rad : {0.0, 0.4, -0.6})
  {
    SCOPED_TRACE(slant_rad);
    const Plane near = slantedPlane(slant_rad, 0.5, 0.58),
                far = slantedPlane(-slant_rad, 1.5, 0.65);
    const auto is_near = [](int u, int v) { return u + v / 3 < 55; };
    RangeImage image =
        imageOf([&](int u, int v) { return (is_near(u, v) ? near : far).depthAlong(rayOf(u, v)); });
    estimateImageNormals(image, kRadius_px, kGate_m, 1);
    double worst_rad = 0;
    for (int v = 0; v < kCamera.height; ++v)
      for (int u = 0; u < kCamera.width; ++u)
        worst_rad = std::max(worst_rad, angleTo(image.normals[image.index(u, v)],
                                                (is_near(u, v) ? near : far).normal));
    EXPECT_LT(worst_rad, 2e-3);
  }
}

TEST(EstimateImageNormals, mixesStepsSmallerThanTheGate)
{
  RangeImage image = imageOf([](int u, int) { return u < 45 ? 0.6 : 0.601; });
  estimateImageNormals(image, kRadius_px, kGate_m, 1);
  EXPECT_GT(angleTo(image.normals[image.index(45, 30)], {0, 0, -1}), 0.05);
  estimateImageNormals(image, kRadius_px, 0.0005F, 1);
  EXPECT_LT(angleTo(image.normals[image.index(45, 30)], {0, 0, -1}), 1e-3);
}

TEST(EstimateImageNormals, staysWithinABoundOnASphere)
{
  constexpr double kSphere_m = 0.05;
  const Eigen::Vector3d center(0.005, -0.004, 0.5);
  RangeImage image = imageOf(
      [&](int u, int v)
      {
        const Eigen::Vector3d ray = rayOf(u, v).cast<double>();
        const double along = center.dot(ray) / ray.squaredNorm();
        const double beside = (center - along * ray).norm();
        return beside < kSphere_m
                   ? along - std::sqrt(kSphere_m * kSphere_m - beside * beside) / ray.norm()
                   : 0.0;
      });
  estimateImageNormals(image, kRadius_px, kGate_m, 1);
  int checked = 0;
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u)
    {
      const Eigen::Vector3f& normal = image.normals[image.index(u, v)];
      if (image.depth[image.index(u, v)] == 0 || normal.isZero()) continue;
      const Eigen::Vector3d truth = (image.point(u, v).cast<double>() - center).normalized();
      EXPECT_LT(normal.dot(image.point(u, v)), 0) << "towards the camera";
      if (-truth.dot(rayOf(u, v).cast<double>().normalized()) < 0.5) continue;
      ++checked;
      EXPECT_LT(angleTo(normal, truth), 0.02) << u << " " << v;
    }
  EXPECT_GT(checked, 1500);
}

TEST(EstimateImageNormals, isTheSameForAnyNumberOfThreads)
{
  std::mt19937 rng(5);
  std::normal_distribution<double> noise(0, 0.0005);
  RangeImage one = imageOf([&](int u, int v) { return 0.6 + 0.001 * u - 0.0005 * v + noise(rng); });
  RangeImage four = one;
  estimateImageNormals(one, kRadius_px, kGate_m, 1);
  estimateImageNormals(four, kRadius_px, kGate_m, 4);
  EXPECT_EQ(one.normals, four.normals);
}

/// Points of a plane, spread at random over a square.
std::vector<Eigen::Vector3f> pointsOn(const Plane& plane, int count, float half_m,
                                      std::uint32_t seed)
{
  std::mt19937 rng(seed);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3f where = randomPoint(rng, half_m);
    const Eigen::Vector3f ray(where.x() / 0.6F, where.y() / 0.6F, 1);
    points.emplace_back(ray * static_cast<float>(plane.depthAlong(ray)));
  }
  return points;
}

TEST(EstimatePointNormals, isExactForPlanesAndPointsToTheOrigin)
{
  for (const double slant_rad : {0.0, 0.5, 1.2})
  {
    SCOPED_TRACE(slant_rad);
    const Plane plane = slantedPlane(slant_rad, 2.0, 0.6);
    for (const Eigen::Vector3f& normal :
         estimatePointNormals(pointsOn(plane, 2000, 0.05F, 1), 12, 0.02F, 1))
      EXPECT_LT(angleTo(normal, plane.normal), 5e-3);
  }
}

TEST(EstimatePointNormals, leavesOutNeighboursBeyondTheRadius)
{
  const Plane near = slantedPlane(0.0, 0.0, 0.6), far = slantedPlane(0.0, 0.0, 0.61);
  std::vector<Eigen::Vector3f> points = pointsOn(near, 100, 0.02F, 1);  // few: 8 within 6 mm
  const std::vector<Eigen::Vector3f> behind = pointsOn(far, 5000, 0.02F, 2);
  points.insert(points.end(), behind.begin(), behind.end());
  const auto mixed = estimatePointNormals(points, 12, 0.05F, 1);
  const auto apart = estimatePointNormals(points, 12, 0.006F, 1);
  int known = 0;
  double worst_mixed_rad = 0;
  for (std::size_t i = 0; i < 100; ++i)
  {
    worst_mixed_rad = std::max(worst_mixed_rad, angleTo(mixed[i], near.normal));
    if (apart[i].isZero()) continue;
    ++known;
    EXPECT_LT(angleTo(apart[i], near.normal), 1e-3);
  }
  EXPECT_GT(known, 70);
  EXPECT_GT(worst_mixed_rad, 0.1) << "the case must be one where the radius decides";
}

TEST(EstimatePointNormals, isZeroWithFewerThanFourNeighbours)
{
  const std::vector<Eigen::Vector3f> three{{0, 0, 1}, {0.01F, 0, 1}, {0, 0.01F, 1}};
  for (const Eigen::Vector3f& normal : estimatePointNormals(three, 12, 1.0F, 1))
    EXPECT_TRUE(normal.isZero());
  std::vector<Eigen::Vector3f> four = three;
  four.emplace_back(0.01F, 0.01F, 1);
  for (const Eigen::Vector3f& normal : estimatePointNormals(four, 12, 1.0F, 1))
    EXPECT_LT(angleTo(normal, {0, 0, -1}), 1e-3);
  EXPECT_TRUE(estimatePointNormals({}, 12, 1.0F, 1).empty());
}

TEST(EstimatePointNormals, doesNotDependOnTheOrderOfThePoints)
{
  const Plane plane = slantedPlane(0.4, 2.0, 0.6);
  std::vector<Eigen::Vector3f> points = pointsOn(plane, 500, 0.05F, 4);
  for (Eigen::Vector3f& point : points)
    point.z() += 0.002F * std::sin(200 * point.x());
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(6));
  std::vector<Eigen::Vector3f> shuffled;
  for (const std::size_t i : order)
    shuffled.push_back(points[i]);
  const auto normals = estimatePointNormals(points, 12, 0.05F, 1);
  const auto of_shuffled = estimatePointNormals(shuffled, 12, 0.05F, 3);
  for (std::size_t i = 0; i < order.size(); ++i)
    EXPECT_LT((of_shuffled[i] - normals[order[i]]).norm(), 1e-4F);
}
}  // namespace
}  // namespace ppf_bin_picking

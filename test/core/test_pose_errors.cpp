#include "ppf_bin_picking/core/pose_errors.hpp"

#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
using Vertices = std::vector<Eigen::Vector3d>;
constexpr double kTiny = 1e-12;
const PinholeCamera kCamera = {640, 480, 600, 500, 319.5F, 239.5F};

Vertices verticesOf(const TriangleMesh& mesh)
{
  Vertices vertices;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    vertices.push_back(vertex.cast<double>());
  return vertices;
}

Eigen::Isometry3d at(const Eigen::Vector3d& place, double angle_rad = 0,
                     const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ())
{
  return Eigen::Translation3d(place) * Eigen::AngleAxisd(angle_rad, axis.normalized());
}

Eigen::Isometry3d randomPose(std::mt19937& rng)
{
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond rotation(normal(rng), normal(rng), normal(rng), normal(rng));
  return Eigen::Translation3d(0.1 * normal(rng), 0.1 * normal(rng), 1 + 0.1 * normal(rng)) *
         rotation.normalized();
}

/// A square prism about the z axis through (1, 2, 0) cm, its half turns and quarter turns.
const Eigen::Vector3f kOffset(0.01F, 0.02F, 0);
const Vertices kPrism = verticesOf(shifted(boxMesh({0.04F, 0.04F, 0.1F}), kOffset));
const SymmetryGroup kPrismTurns({{{Eigen::Vector3d::UnitZ(), kOffset.cast<double>()}, M_PI / 2},
                                 {{Eigen::Vector3d::UnitX(), kOffset.cast<double>()}, M_PI}},
                                {});

/// A tube about z, turned around freely; also end for end.
Vertices tube(int around)
{
  const auto surface = [](float turn, float rise)
  {
    const float angle = 2 * static_cast<float>(M_PI) * turn;
    return Eigen::Vector3f(0.02F * std::cos(angle), 0.02F * std::sin(angle), 0.1F * rise - 0.05F);
  };
  return verticesOf(tubeMesh(around, 1, surface));
}
const SymmetryAxis kAxis = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};

/// MSSD by its definition: every symmetry, every vertex.
double slowMssd(const Vertices& vertices, const std::vector<Eigen::Isometry3d>& motions,
                const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
{
  double best = PoseErrors::kAnyDistance;
  for (const Eigen::Isometry3d& motion : motions)
  {
    double largest = 0;
    for (const Eigen::Vector3d& x : vertices)
      largest = std::max(largest, (found * x - truth * (motion * x)).norm());
    best = std::min(best, largest);
  }
  return best;
}

double slowMspd(const Vertices& vertices, const std::vector<Eigen::Isometry3d>& motions,
                const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
{
  double best = PoseErrors::kAnyDistance;
  const auto pixel = [](const Eigen::Vector3d& p)
  {
    return Eigen::Vector2d(kCamera.fx * p.x() / p.z() + kCamera.cx,
                           kCamera.fy * p.y() / p.z() + kCamera.cy);
  };
  for (const Eigen::Isometry3d& motion : motions)
  {
    double largest = 0;
    for (const Eigen::Vector3d& x : vertices)
      largest = std::max(largest, (pixel(found * x) - pixel(truth * (motion * x))).norm());
    best = std::min(best, largest);
  }
  return best;
}

TEST(Mssd, isTheLengthOfAShift)
{
  const PoseErrors errors(kPrism, SymmetryGroup());
  const Eigen::Isometry3d truth = at({0.1, 0.2, 0.7}, 0.4, {1, 2, 3});
  const Eigen::Isometry3d found = Eigen::Translation3d(0.003, -0.004, 0.012) * truth;
  const NearestTruth nearest = errors.mssd(found, truth);
  EXPECT_NEAR(nearest.error_m, 0.013, kTiny);
  EXPECT_TRUE(nearest.T_camera_model.isApprox(truth));
  EXPECT_NEAR(errors.translation(found, truth), 0.013, kTiny);
  EXPECT_NEAR(errors.rotation(found, truth), 0, 1e-7);
}

TEST(Mssd, ofATurnIsTheChordOfTheFarthestVertex)
{
  const PoseErrors errors(verticesOf(boxMesh({0.06F, 0.08F, 0.01F})), SymmetryGroup());
  const NearestTruth nearest = errors.mssd(at({0, 0, 1}, 0.3), at({0, 0, 1}));
  EXPECT_NEAR(nearest.error_m, 2 * 0.05 * std::sin(0.15), 1e-9);  // corners 5 cm from the axis
  EXPECT_NEAR(errors.rotation(at({0, 0, 1}, 0.3), at({0, 0, 1})), 0.3, kTiny);
}

TEST(Mssd, ofASymmetricTurnIsZero)
{
  const PoseErrors errors(kPrism, kPrismTurns);
  ASSERT_EQ(kPrismTurns.motions().size(), 8U);
  const Eigen::Isometry3d truth = at({0.1, 0.2, 0.7}, 0.4, {1, 2, 3});
  for (const Eigen::Isometry3d& motion : kPrismTurns.motions())
  {
    const NearestTruth nearest = errors.mssd(truth * motion, truth);
    EXPECT_NEAR(nearest.error_m, 0, kTiny);
    EXPECT_NEAR(errors.rotation(truth * motion, nearest.T_camera_model), 0, 1e-7);
  }
  const PoseErrors without(kPrism, SymmetryGroup());
  EXPECT_GT(without.mssd(truth * kPrismTurns.motions().back(), truth).error_m, 0.03);
}

TEST(Mssd, ofARevolutionIsWithinHalfAStep)
{
  const PoseErrors errors(tube(360), SymmetryGroup({}, {kAxis}));
  const Eigen::Isometry3d truth = at({0, 0.1, 0.8}, 1, {1, 0, 1});
  for (int degree = 0; degree < 360; ++degree)
  {
    const Eigen::Isometry3d found = truth * at({0, 0, 0}, degree * M_PI / 180);
    const double expected = degree % 2 == 0 ? 0 : 2 * 0.02 * std::sin(0.5 * M_PI / 180);
    const NearestTruth nearest = errors.mssd(found, truth);
    EXPECT_NEAR(nearest.error_m, expected, 1e-9) << degree;
    EXPECT_NEAR(errors.rotation(found, nearest.T_camera_model), 0, 1e-7);
  }
  const Eigen::Isometry3d over = truth * at({0, 0, 0}, M_PI, {1, 0, 0});
  EXPECT_GT(errors.mssd(over, truth).error_m, 0.09);
}

TEST(Mssd, ofARevolutionTimesAHalfTurn)
{
  const SymmetryGroup group({{{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}, M_PI}}, {kAxis});
  const PoseErrors errors(tube(90), group);
  const Eigen::Isometry3d truth = at({0, 0.1, 0.8}, 1, {1, 0, 1});
  for (int degree = 0; degree < 360; degree += 10)
  {
    const Eigen::Isometry3d found =
        truth * at({0, 0, 0}, degree * M_PI / 180) * at({0, 0, 0}, M_PI, {1, 0, 0});
    const NearestTruth nearest = errors.mssd(found, truth);
    EXPECT_NEAR(nearest.error_m, 0, 1e-9);
    EXPECT_NEAR(errors.rotation(found, nearest.T_camera_model), 0, 1e-7);
  }
}

TEST(Mssd, ofASphereIsTheDistanceOfTheCentres)
{
  const Eigen::Vector3d center(0.01, -0.02, 0.03);
  const SymmetryGroup group({}, {{Eigen::Vector3d::UnitZ(), center + Eigen::Vector3d(0, 0, 0.5)},
                                 {Eigen::Vector3d::UnitX(), center}});
  const PoseErrors errors(verticesOf(shifted(sphereMesh(0.02F), center.cast<float>())), group);
  std::mt19937 rng(1);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Isometry3d found = randomPose(rng);
    const Eigen::Isometry3d truth = randomPose(rng);
    const NearestTruth nearest = errors.mssd(found, truth);
    EXPECT_NEAR(nearest.error_m, (found * center - truth * center).norm(), 1e-9);
    EXPECT_NEAR(errors.rotation(found, nearest.T_camera_model), 0, 1e-7);
  }
}

TEST(Errors, areThoseOfTheirDefinition)
{
  const PoseErrors errors(kPrism, kPrismTurns);
  std::mt19937 rng(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    SCOPED_TRACE(trial);
    const Eigen::Isometry3d found = randomPose(rng);
    const Eigen::Isometry3d truth = randomPose(rng);
    const double mssd = slowMssd(kPrism, kPrismTurns.motions(), found, truth);
    const double mspd = slowMspd(kPrism, kPrismTurns.motions(), found, truth);
    EXPECT_NEAR(errors.mssd(found, truth).error_m, mssd, kTiny);
    EXPECT_NEAR(errors.mspd(found, truth, kCamera), mspd, 1e-6);
    EXPECT_NEAR(errors.mssd(found, truth, mssd + 1e-9).error_m, mssd, kTiny);
    EXPECT_EQ(errors.mssd(found, truth, mssd - 1e-9).error_m, PoseErrors::kAnyDistance);
    EXPECT_NEAR(errors.mspd(found, truth, kCamera, mspd + 1e-5), mspd, 1e-6);
    EXPECT_EQ(errors.mspd(found, truth, kCamera, mspd - 1e-5), PoseErrors::kAnyDistance);
  }
}

TEST(Errors, doNotChangeWithTheCamerasPlace)
{
  const PoseErrors errors(kPrism, kPrismTurns);
  std::mt19937 rng(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Isometry3d move = randomPose(rng);
    const Eigen::Isometry3d a = randomPose(rng);
    const Eigen::Isometry3d b = randomPose(rng);
    EXPECT_NEAR(errors.mssd(move * a, move * b).error_m, errors.mssd(a, b).error_m, 1e-9);
    EXPECT_NEAR(errors.mssd(a, b).error_m, errors.mssd(b, a).error_m, 1e-9);
    EXPECT_NEAR(errors.rotation(move * a, move * b), errors.rotation(a, b), 1e-6);
    EXPECT_NEAR(errors.translation(move * a, move * b), errors.translation(a, b), 1e-9);
  }
}

TEST(Mspd, ofAShiftedSquareIsTheShiftInPixels)
{
  const PoseErrors errors(verticesOf(squareMesh(0.05F)), SymmetryGroup());
  const Eigen::Isometry3d truth = at({0, 0, 0.5});
  EXPECT_NEAR(errors.mspd(at({0.01, 0, 0.5}), truth, kCamera), 600 * 0.01 / 0.5, 1e-9);
  EXPECT_NEAR(errors.mspd(at({0, 0.01, 0.5}), truth, kCamera), 500 * 0.01 / 0.5, 1e-9);
  // Away from the camera the corners, at 600 * 0.05 and 500 * 0.05, move to the middle.
  EXPECT_NEAR(errors.mspd(at({0, 0, 1}), truth, kCamera), std::hypot(30.0, 25.0), 1e-6);
}

TEST(Mspd, behindTheCameraIsInfinite)
{
  const PoseErrors errors(verticesOf(squareMesh(0.05F)), SymmetryGroup());
  EXPECT_EQ(errors.mspd(at({0, 0, -1}), at({0, 0, 1}), kCamera), PoseErrors::kAnyDistance);
  EXPECT_EQ(errors.mspd(at({0, 0, 1}), at({0, 0, -1}), kCamera), PoseErrors::kAnyDistance);
}

TEST(Diameter, isTheLargestOfAllDistances)
{
  std::mt19937 rng(4);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial)
  {
    const int count = 1 + trial * 30;
    Vertices vertices;
    for (int i = 0; i < count; ++i)
      vertices.emplace_back(normal(rng), 3 * normal(rng), 0.1 * normal(rng));
    double slow = 0;
    for (const Eigen::Vector3d& a : vertices)
      for (const Eigen::Vector3d& b : vertices)
        slow = std::max(slow, (a - b).norm());
    EXPECT_NEAR(PoseErrors(vertices, SymmetryGroup()).diameter(), slow, kTiny) << count;
  }
  EXPECT_NEAR(PoseErrors(kPrism, SymmetryGroup()).diameter(),
              std::sqrt(2 * 0.04 * 0.04 + 0.1 * 0.1), 1e-8);
}

TEST(Vertices, areThinnedOutEvenly)
{
  // Of points along x, a turn about z at the first one moves the last one farthest; the mean of an
  // even choice is the middle.
  Vertices vertices;
  for (int i = 0; i < 12345; ++i)
    vertices.emplace_back(i * 1e-5, 0, 0);
  const PoseErrors errors(vertices, SymmetryGroup());
  EXPECT_NEAR(errors.diameter(), 0.12344, kTiny);
  const Eigen::Isometry3d half_turn = at({0, 0, 0}, M_PI);
  EXPECT_NEAR(errors.mssd(half_turn, at({0, 0, 0})).error_m, 2 * 0.12344, kTiny);
  EXPECT_NEAR(errors.translation(half_turn, at({0, 0, 0})), 0.12344, 1e-8);
  const Vertices few(vertices.begin(), vertices.begin() + 1000);
  EXPECT_NEAR(PoseErrors(few, SymmetryGroup()).translation(half_turn, at({0, 0, 0})), 0.00999,
              kTiny);
}

TEST(Vertices, mustBeThereAndFinite)
{
  EXPECT_THROW(PoseErrors({}, SymmetryGroup()), std::invalid_argument);
  EXPECT_THROW(PoseErrors({{0, NAN, 0}}, SymmetryGroup()), std::invalid_argument);
  EXPECT_EQ(PoseErrors({{1, 2, 3}}, SymmetryGroup()).diameter(), 0);
}
}  // namespace
}  // namespace ppf_bin_picking

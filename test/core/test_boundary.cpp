#include "ppf_bin_picking/core/boundary.hpp"
#include "ppf_bin_picking/core/boundary_matcher.hpp"
#include "ppf_bin_picking/core/pose_clustering.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr float kJump_m = 0.002F;
constexpr float kNormalGate_m = 0.005F;
constexpr float kPixel_m = 0.001F;  // of smallCamera() at 0.6 m

/// A square of 0.12 m before a wall, turned and tilted.
class SquareBeforeWall : public ::testing::Test
{
protected:
  RangeImage image() const
  {
    return imageOf({wall(0.65), {squareMesh(0.06F), T_camera_square_}}, kNormalGate_m);
  }

  /// The square's half side, as squareMesh() draws it.
  const float half_m_ = squareMesh(0.06F).vertices.front().cwiseAbs().maxCoeff();
  const Eigen::Isometry3d T_camera_square_ = poseOf(M_PI, {1, 0, 0}, {0.01, -0.02, 0.6}) *
                                             poseOf(0.4, {1, 0.3, 0}, {0, 0, 0}) *
                                             poseOf(0.7, {0, 0, 1}, {0, 0, 0});
};

TEST_F(SquareBeforeWall, hasItsBoundaryOnItsSidesWithFramesThatPointOffIt)
{
  const std::vector<BoundaryPoint> points = boundaryOf(image(), kJump_m, 1);
  const Eigen::Isometry3f T_square_camera = T_camera_square_.inverse().cast<float>();
  std::array<int, 4> of_side{};
  std::size_t well_directed = 0;
  for (const BoundaryPoint& boundary : points)
  {
    const Eigen::Vector3f p = T_square_camera * boundary.point;
    const Eigen::Vector3f outward = T_square_camera.linear() * boundary.outward;
    EXPECT_NEAR(p.z(), 0, 0.3F * kPixel_m);
    EXPECT_NEAR(p.head<2>().cwiseAbs().maxCoeff(), half_m_, 1.5F * kPixel_m);
    EXPECT_GT((T_square_camera.linear() * boundary.normal).z(), 0.99F);
    EXPECT_NEAR(boundary.outward.dot(boundary.normal), 0, 1e-4F);
    Eigen::Index side = 0;
    p.head<2>().cwiseAbs().maxCoeff(&side);
    const bool positive = p(side) > 0;
    ++of_side[static_cast<std::size_t>(2 * side + (positive ? 1 : 0))];
    if ((positive ? outward(side) : -outward(side)) > std::cos(0.3F)) ++well_directed;
  }
  for (const int count : of_side)
    EXPECT_GT(count, 60);
  EXPECT_GT(static_cast<double>(well_directed), 0.9 * static_cast<double>(points.size()));
}

TEST_F(SquareBeforeWall, hasNoBoundaryWithoutAStepBehindIt)
{
  RangeImage alone = imageOf({{squareMesh(0.06F), T_camera_square_}}, kNormalGate_m);
  EXPECT_TRUE(boundaryOf(alone, kJump_m, 1).empty()) << "nothing measured is no step";
  const RangeImage flat = imageOf({wall(0.65)}, kNormalGate_m);
  EXPECT_TRUE(boundaryOf(flat, kJump_m, 1).empty());
  EXPECT_TRUE(boundaryOf(image(), 0.2F, 1).empty()) << "the wall is less than 0.2 m behind";
}

TEST_F(SquareBeforeWall, keepsItsBoundaryWhereAShadowLiesBesideIt)
{
  RangeImage with_shadow = image();
  const std::size_t before = boundaryOf(with_shadow, kJump_m, 1).size();
  const RangeImage whole = with_shadow;
  for (int v = 0; v < whole.camera.height; ++v)
    for (int u = 6; u < whole.camera.width; ++u)
      if (whole.depth[whole.index(u, v)] > 0.64F && whole.depth[whole.index(u - 6, v)] < 0.63F)
        with_shadow.depth[whole.index(u, v)] = 0;
  const std::size_t after = boundaryOf(with_shadow, kJump_m, 1).size();
  EXPECT_GT(static_cast<double>(after), 0.9 * static_cast<double>(before));
}

TEST_F(SquareBeforeWall, isLeftOutWhereTheRegionEnds)
{
  RangeImage outside = image();
  outside.in_roi.assign(outside.in_roi.size(), 0);
  EXPECT_TRUE(boundaryOf(outside, kJump_m, 1).empty());
}

TEST(ThinOutBoundary, joinsPointsOfACellOnlyIfTheyPointTheSameWay)
{
  const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY(),
                        z = Eigen::Vector3f::UnitZ();
  const std::vector<BoundaryPoint> thin = thinOutBoundary({{{0.001F, 0.001F, 0}, z, x},
                                                           {{0.003F, 0.001F, 0}, z, x},
                                                           {{0.003F, 0.001F, 0}, z, y},
                                                           {{0.003F, 0.001F, 0}, x, y},
                                                           {{0.013F, 0.001F, 0}, z, x}},
                                                          0.01F);
  ASSERT_EQ(thin.size(), 4U);
  EXPECT_TRUE(thin[0].point.isApprox(Eigen::Vector3f(0.002F, 0.001F, 0)));
  EXPECT_EQ(thin[1].outward, y);
  EXPECT_EQ(thin[2].normal, x);
  EXPECT_NEAR(thin[3].point.x(), 0.013F, 1e-6F);
}

/// A box, whose faces alone leave three motions open.
class BoxByItsEdges : public ::testing::Test
{
protected:
  BoxByItsEdges() { config_.model.step_rel = 0.1; }

  std::vector<BoundaryPoint> boundaryAt(const Eigen::Isometry3d& T_camera_box) const
  {
    const auto diameter_m = static_cast<float>(model_.diameter());
    return thinOutBoundary(
        boundaryOf(imageOf({wall(0.75), {boxMesh(size_m_), T_camera_box}}, kNormalGate_m),
                   boundaryJump(diameter_m), 1),
        boundarySpacing(diameter_m));
  }

  DetectorConfig config_;
  const Eigen::Vector3f size_m_{0.08F, 0.05F, 0.03F};
  const SymmetryGroup half_turns_{{{{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}, M_PI},
                                   {{Eigen::Vector3d::UnitY(), Eigen::Vector3d::Zero()}, M_PI}},
                                  {}};
  const PpfModel model_ = PpfModel::train(boxMesh(size_m_), half_turns_,
                                          []
                                          {
                                            ModelParameters coarse;
                                            coarse.step_rel = 0.1;
                                            return coarse;
                                          }());
};

TEST_F(BoxByItsEdges, isFoundInAnyPose)
{
  std::mt19937 rng(3);
  int right = 0;
  constexpr int kPoses = 20;
  for (int i = 0; i < kPoses; ++i)
  {
    Eigen::Isometry3d truth = randomPose(rng, 0.02);
    truth.translation().z() += 0.6;
    const std::vector<PoseGroup> groups =
        groupPoses(config_, model_, matchBoundary(boundaryAt(truth), model_, config_, Deadline()));
    ASSERT_FALSE(groups.empty());
    const Eigen::Vector3d center = truth * model_.data().center.cast<double>();
    const bool found =
        (groups[0].center.cast<double>() - center).norm() < 0.1 * model_.diameter() &&
        half_turns_.rotationDistance(groups[0].rotation,
                                     Eigen::Quaternionf(truth.linear().cast<float>())) < 0.3;
    right += found ? 1 : 0;
  }
  EXPECT_GE(right, kPoses - 2);
}

TEST_F(BoxByItsEdges, hasTheSameHypothesesForAnyNumberOfThreads)
{
  const std::vector<BoundaryPoint> scene = boundaryAt(poseOf(0.6, {1, 2, 3}, {0.01, 0, 0.6}));
  config_.threads = 1;
  const auto one = matchBoundary(scene, model_, config_, Deadline());
  config_.threads = 4;
  const auto four = matchBoundary(scene, model_, config_, Deadline());
  ASSERT_EQ(one.size(), four.size());
  ASSERT_FALSE(one.empty());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].center, four[i].center);
    EXPECT_EQ(one[i].rotation.coeffs(), four[i].rotation.coeffs());
    EXPECT_EQ(one[i].votes, four[i].votes);
  }
}

TEST_F(BoxByItsEdges, votesAsAPlainCountOverAllPairsDoes)
{
  const std::vector<BoundaryPoint> scene = boundaryAt(poseOf(0.6, {1, 2, 3}, {0.01, 0, 0.6}));
  config_.peaks_per_reference = 1;
  const auto found = matchBoundary(scene, model_, config_, Deadline());
  const BoundaryTable& table = model_.data().boundary;
  const BoundaryQuantizer quantizer(model_.data().diameter_m);
  std::size_t next = 0;
  for (const BoundaryPoint& first : scene)
  {
    std::vector<int> votes(table.points.size(), 0);
    for (const BoundaryPoint& second : scene)
    {
      const std::uint32_t key = quantizer.key(boundaryReference(first), second);
      if (key == kNoKey) continue;
      for (std::uint32_t k = table.offsets[key]; k < table.offsets[key + 1]; ++k)
        ++votes[table.entries[k]];
    }
    const int most = *std::max_element(votes.begin(), votes.end());
    if (most == 0) continue;
    ASSERT_LT(next, found.size());
    EXPECT_EQ(found[next++].votes, static_cast<float>(most));
  }
  EXPECT_EQ(next, found.size());
}

TEST(BoundaryQuantizer, numbersAPairTheSameWhereverItLies)
{
  std::mt19937 rng(5);
  const BoundaryQuantizer quantizer(0.1F);
  int same = 0, keyed = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const auto random = [&]
    {
      const Eigen::Vector3f normal = randomDirection(rng);
      return BoundaryPoint{randomPoint(rng, 0.04F), normal, normal.unitOrthogonal()};
    };
    const BoundaryPoint a = random(), b = random();
    const Eigen::Isometry3f motion = randomPose(rng, 1).cast<float>();
    const auto moved = [&](const BoundaryPoint& p)
    {
      return BoundaryPoint{motion * p.point, motion.linear() * p.normal,
                           motion.linear() * p.outward};
    };
    const std::uint32_t key = quantizer.key(boundaryReference(a), b);
    if (key == kNoKey) continue;
    ++keyed;
    EXPECT_LT(key, BoundaryQuantizer::keyCount());
    const std::uint32_t moved_key = quantizer.key(boundaryReference(moved(a)), moved(b));
    same += moved_key == key ? 1 : 0;
  }
  EXPECT_GT(keyed, 500);
  EXPECT_GE(same, keyed - 2) << "rounding may push a pair over a border of its cell, rarely";
}
}  // namespace
}  // namespace ppf_bin_picking

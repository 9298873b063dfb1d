#include "ppf_bin_picking/core/sample_balance.hpp"

#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace ppf_bin_picking
{
namespace
{
constexpr float kGate_m = 0.003F;

/// A square of 0.1 m that faces the camera at 0.5 m, before a wall; samples of the square in its
/// own frame.
class SampleBalanceTest : public ::testing::Test
{
protected:
  SampleBalanceTest()
  {
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 10; ++column)
        addSample(0.008F * static_cast<float>(column) - 0.036F,
                  0.008F * static_cast<float>(row) - 0.036F, {0, 0, -1});
  }

  void addSample(float x, float y, const Eigen::Vector3f& normal)
  {
    samples_.add(Eigen::Vector3f(x, y, 0).data(), normal.data());
  }

  /// What the samples say where the square is at a depth.
  float balanceAt(float z_m) const
  {
    const Eigen::Isometry3f T(Eigen::Translation3f(0, 0, z_m));
    return sampleBalance(image_, samples_, T, kGate_m, config_);
  }

  /// Sets what the image shows of half of the samples, those left of the middle.
  template <typename Change>
  void changeLeftHalf(const Change& change)
  {
    for (int v = 0; v < image_.camera.height; ++v)
      for (int u = 0; u < image_.camera.width; ++u)
        if (static_cast<float>(u) < image_.camera.cx) change(image_.index(u, v));
  }

  RangeImage image_ =
      imageOf({wall(0.6), {squareMesh(0.1F), poseOf(M_PI, {1, 0, 0}, {0, 0, 0.5})}}, 0.004F, 0);
  PointArrays samples_;
  DetectorConfig config_;
};

TEST_F(SampleBalanceTest, isTheShareConfirmedLessWhatContradicts)
{
  EXPECT_FLOAT_EQ(balanceAt(0.5F), 1);
  EXPECT_FLOAT_EQ(balanceAt(0.502F), 1) << "within the gate";
  EXPECT_FLOAT_EQ(balanceAt(0.45F), -2) << "looked through";
  EXPECT_FLOAT_EQ(balanceAt(0.55F), 0) << "hidden";
}

TEST_F(SampleBalanceTest, countsEachSampleByItsOwnPixel)
{
  const RangeImage whole = image_;
  changeLeftHalf([&](std::size_t i) { image_.depth[i] = 0; });
  EXPECT_NEAR(balanceAt(0.5F), 0.5 - 0.5 * 0.4, 1e-5) << "missing";
  image_ = whole;
  changeLeftHalf([&](std::size_t i) { image_.normals[i] = Eigen::Vector3f(1, 0, 0); });
  EXPECT_NEAR(balanceAt(0.5F), 0.5 - 0.5, 1e-5) << "another normal";
  image_ = whole;
  changeLeftHalf([&](std::size_t i) { image_.normals[i].setZero(); });
  EXPECT_NEAR(balanceAt(0.5F), 1, 1e-5) << "no normal";
  image_ = whole;
  changeLeftHalf([&](std::size_t i) { image_.in_roi[i] = 0; });
  EXPECT_NEAR(balanceAt(0.5F), 0.5, 1e-5) << "outside the region";
}

TEST_F(SampleBalanceTest, leavesOutWhatDoesNotFaceTheCamera)
{
  addSample(0, 0, {1, 0, 0});
  addSample(0, 0, {0, 0, 1});
  EXPECT_FLOAT_EQ(balanceAt(0.5F), 1);
}

TEST_F(SampleBalanceTest, isZeroWhereNoSampleCounts)
{
  samples_ = PointArrays();
  EXPECT_EQ(balanceAt(0.5F), 0);
}
}  // namespace
}  // namespace ppf_bin_picking

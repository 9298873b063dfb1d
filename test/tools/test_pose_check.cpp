#include "ppf_bin_picking/core/model_renderer.hpp"
#include "ppf_bin_picking/core/normals.hpp"

#include "pose_check.hpp"
#include "pose_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
void addBox(const Eigen::Vector3f& low, const Eigen::Vector3f& high, TriangleMesh& mesh)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                               (k & 4) != 0 ? high.z() : low.z());
  const std::uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                      {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                      {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& face : faces)
    mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
}

/// A bar of 80 x 20 x 20 mm with a step of 8 mm on one end: almost the same when turned about z.
TriangleMesh bar()
{
  TriangleMesh mesh;
  addBox({-0.04F, -0.01F, -0.01F}, {0.04F, 0.01F, 0.01F}, mesh);
  addBox({0.02F, -0.01F, 0.01F}, {0.04F, 0.01F, 0.018F}, mesh);
  return mesh;
}

class PoseCheckTest : public testing::Test
{
protected:
  /// What the camera sees of bars at the poses, above a floor.
  RangeImage seen(const std::vector<Eigen::Isometry3f>& poses) const
  {
    RangeImage image;
    image.camera = {320, 240, 800, 800, 159.5F, 119.5F};
    const std::size_t pixels = 320 * 240;
    image.depth.assign(pixels, 0.6F);
    image.in_roi.assign(pixels, 1);
    RenderedPart view;
    for (const Eigen::Isometry3f& pose : poses)
    {
      renderPart(model_.renderable(), pose, image.camera, view);
      for (int row = 0; row < view.height; ++row)
        for (int column = 0; column < view.width; ++column)
        {
          float& depth = image.depth[image.index(view.left + column, view.top + row)];
          if (view.depthAt(column, row) > 0) depth = std::min(depth, view.depthAt(column, row));
        }
    }
    estimateImageNormals(image, 2, 0.004F, 1);
    return image;
  }
  /// The bar lying under the camera, step upwards, turned about the line of sight.
  static Eigen::Isometry3f lying(float x_m, float angle_rad)
  {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = Eigen::Vector3f(x_m, 0, 0.55F);
    pose.linear() = (Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitZ()) *
                     Eigen::AngleAxisf(static_cast<float>(M_PI), Eigen::Vector3f::UnitX()))
                        .toRotationMatrix();
    return pose;
  }

  const PpfModel model_ = PpfModel::train(bar(), SymmetryGroup(), ModelParameters());
  const DetectorConfig config_;
};

TEST_F(PoseCheckTest, findsNothingAgainstARightPose)
{
  const RangeImage image = seen({lying(0, 0.3F)});
  const PoseCheck check = PoseChecker(image, model_, config_).check({lying(0, 0.3F)}).front();
  EXPECT_EQ(check.verdict, "ok");
  EXPECT_LT(check.rmse_m, 0.0005);
  EXPECT_GT(check.turned_m, 2 * check.both_ways_m);
  EXPECT_LT(check.looked_through, 0.01);
  EXPECT_EQ(check.overlap_with, -1);
}

TEST_F(PoseCheckTest, seesThatAPoseIsTurnedEndForEnd)
{
  const RangeImage image = seen({lying(0, 0.3F)});
  const auto turned = lying(0, 0.3F + static_cast<float>(M_PI));
  const PoseCheck check = PoseChecker(image, model_, config_).check({turned}).front();
  EXPECT_NE(check.verdict.find("fits better turned about"), std::string::npos) << check.verdict;
  EXPECT_LT(check.turned_m, 0.7 * check.both_ways_m);
}

TEST_F(PoseCheckTest, seesThatACloudLiesBehind)
{
  const RangeImage image = seen({lying(0, 0)});
  const PoseCheck check = PoseChecker(image, model_, config_).check({lying(0.05F, 0)}).front();
  EXPECT_NE(check.verdict.find("looked through"), std::string::npos) << check.verdict;
  EXPECT_GT(check.looked_through, 0.4);
}

TEST_F(PoseCheckTest, seesThatPartsShareSpace)
{
  const auto one = lying(0, 0);
  const auto other = lying(0, 0.8F);
  const auto checks = PoseChecker(seen({one, other}), model_, config_).check({one, other});
  for (const PoseCheck& check : checks)
    EXPECT_NE(check.verdict.find("inside another part"), std::string::npos) << check.verdict;
  EXPECT_EQ(checks[0].overlap_with, 1);
  EXPECT_EQ(checks[1].overlap_with, 0);
}

TEST_F(PoseCheckTest, letsPartsTouch)
{
  const auto right = lying(0.04F, 0);
  const auto left = lying(-0.04F, 0);
  const auto checks = PoseChecker(seen({right, left}), model_, config_).check({right, left});
  EXPECT_EQ(checks[0].verdict, "ok");
  EXPECT_EQ(checks[1].verdict, "ok");
}

TEST_F(PoseCheckTest, drawsReliablePosesGreenAndOthersRed)
{
  const RangeImage image = seen({lying(-0.05F, 0), lying(0.05F, 0)});
  const cv::Mat picture = drawPoses(image, model_.renderable(),
                                    {{lying(-0.05F, 0), true, "0"}, {lying(0.05F, 0), false, "1"}});
  int green = 0;
  int red = 0;
  for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(picture))
  {
    green += pixel[1] > 200 && pixel[0] < 100 && pixel[2] < 100 ? 1 : 0;
    red += pixel[2] > 200 && pixel[0] < 100 && pixel[1] < 100 ? 1 : 0;
  }
  EXPECT_GT(green, 100);
  EXPECT_GT(red, 100);
  EXPECT_GE(picture.rows, 2 * image.camera.height);
}

TEST(NearSymmetries, leaveOutTheTrueOnes)
{
  const ModelParameters parameters;
  EXPECT_EQ(nearSymmetries(PpfModel::train(bar(), SymmetryGroup(), parameters)).size(), 3U);
  const SymmetryGroup half_turn({{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, M_PI}}, {});
  EXPECT_EQ(nearSymmetries(PpfModel::train(bar(), half_turn, parameters)).size(), 2U);
  const SymmetryGroup pin({}, {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}});
  const auto turns = nearSymmetries(PpfModel::train(bar(), pin, parameters));
  ASSERT_EQ(turns.size(), 1U);
  EXPECT_EQ(turns[0].name, "end for end");
  const SymmetryGroup rod({{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()}, M_PI}},
                          {{Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()}});
  EXPECT_TRUE(nearSymmetries(PpfModel::train(bar(), rod, parameters)).empty());
}
}  // namespace
}  // namespace ppf_bin_picking

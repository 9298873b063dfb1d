#include "ppf_bin_picking/io/depth_io.hpp"

#include "support/files.hpp"
#include "support/small_png.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMany = 1000;
const char* const kCamera =
    "width: 3\nheight: 2\nfx: 1786.57788\nfy: 1785.74548\ncx: 984.213745\ncy: 609.480774\n"
    "depth_unit_m: 2.0e-05\nframe_id: camera_optical\n";

class DepthImage : public testing::Test
{
protected:
  DepthCamera camera(const std::string& text = kCamera) const
  {
    return loadDepthCamera(folder_.write("camera.yaml", text));
  }
  PointCloud load(const std::string& png, std::size_t max_points = kMany) const
  {
    return loadDepthCloud(folder_.write("depth.png", png), camera(), max_points);
  }
  std::string error(const std::string& png, std::size_t max_points = kMany) const
  {
    return inputError([&] { load(png, max_points); });
  }

  TemporaryFolder folder_;
  const std::vector<std::uint16_t> levels_ = {0, 25000, 1, 30000, 65535, 2};
};

TEST_F(DepthImage, becomesAnOrganisedCloudInSinglePrecision)
{
  const PointCloud cloud = load(pngOf(levels_, 3));
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.height, 2U);
  ASSERT_EQ(cloud.size(), 6U);
  EXPECT_FALSE(cloud.points[0].allFinite());
  const float z = 25000.0F * 2.0e-05F;
  EXPECT_EQ(cloud.points[1].x(), (1.0F - 984.213745F) / 1786.57788F * z);
  EXPECT_EQ(cloud.points[1].y(), (0.0F - 609.480774F) / 1785.74548F * z);
  EXPECT_EQ(cloud.points[1].z(), z);
  EXPECT_TRUE(cloud.normals.empty());
}

TEST_F(DepthImage, comesWithItsCamera)
{
  const DepthCamera loaded = camera();
  EXPECT_EQ(loaded.pinhole.width, 3);
  EXPECT_EQ(loaded.pinhole.cy, 609.480774F);
  EXPECT_EQ(loaded.frame_id, "camera_optical");
}

TEST_F(DepthImage, isRefusedWithAnIncompleteCamera)
{
  expectHolds(inputError([&] { camera(std::string(kCamera) + "skew: 0\n"); }),
              "unknown key 'skew'");
  expectHolds(inputError([&] { camera("width: 3\nheight: 2\n"); }), "fx is missing");
  const auto replaced = [](const std::string& from, const std::string& to)
  {
    std::string text = kCamera;
    return text.replace(text.find(from), from.size(), to);
  };
  expectHolds(inputError([&] { camera(replaced("fx: 1786.57788", "fx: 0")); }), "fx is 0");
  expectHolds(inputError([&] { camera(replaced("width: 3", "width: -3")); }), "width is -3");
  expectHolds(inputError([&] { camera(replaced("2.0e-05", "0")); }), "depth_unit_m is 0");
  expectHolds(inputError([&] { camera(replaced("2.0e-05", "1e-60")); }), "depth_unit_m is '1e-60'");
}

TEST_F(DepthImage, isRefusedIfOfAnotherKind)
{
  expectHolds(error("\xff\xd8\xff"), "it is no PNG");
  expectHolds(error(""), "it is no PNG");
  expectHolds(error(pngOf(std::vector<std::uint8_t>(6, 9), 3)), "a PNG of another kind");
  expectHolds(error(pngOf(levels_, 2)), "has 2 x 3 pixels but its camera file says 3 x 2");
  expectHolds(error(pngOf(levels_, 3), 5), "holds 6 points, more than max_points (5)");
  expectHolds(error(pngOf(std::vector<std::uint16_t>(6, 0), 3)), "holds no measured point");
}

TEST_F(DepthImage, isRefusedIfCutOffAnywhere)
{
  const std::string whole = pngOf(levels_, 3);
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    SCOPED_TRACE(size);
    expectHolds(error(whole.substr(0, size)), "depth.png cannot be used");
  }
}

TEST_F(DepthImage, isRefusedIfAnyByteIsWrong)
{
  const std::string whole = pngOf(levels_, 3);
  for (std::size_t at = 0; at < whole.size(); ++at)
  {
    SCOPED_TRACE(at);
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    expectHolds(error(damaged), "depth.png cannot be used");
  }
}
}  // namespace
}  // namespace ppf_bin_picking

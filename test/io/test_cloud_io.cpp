#include "ppf_bin_picking/io/cloud_io.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <limits>
#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kMany = 1000;

pcl::PointCloud<pcl::PointNormal> threeByTwo()
{
  pcl::PointCloud<pcl::PointNormal> cloud(3, 2);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud[i].x = 0.1F * static_cast<float>(i);
    cloud[i].y = -0.2F;
    cloud[i].z = 0.5F;
    cloud[i].normal_z = -1;
  }
  cloud[4].x = cloud[4].y = cloud[4].z = std::numeric_limits<float>::quiet_NaN();
  return cloud;
}

const char* const kHead = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const char* const kView = "VIEWPOINT 0 0 0 1 0 0 0\n";

class CloudFile : public testing::Test
{
protected:
  LoadedCloud load(const std::string& name, LengthUnit unit = LengthUnit::kMetre,
                   std::size_t max_points = kMany) const
  {
    return loadCloud(folder_.file(name), unit, max_points);
  }
  std::string error(const std::string& name, std::size_t max_points = kMany) const
  {
    return inputError([&] { load(name, LengthUnit::kMetre, max_points); });
  }
  std::string errorOf(const std::string& name, const std::string& content) const
  {
    folder_.write(name, content);
    return error(name);
  }
  /// Size lines for n points of text, and one point.
  static std::string asciiPcd(const std::string& sizes)
  {
    return std::string(kHead) + sizes + kView + "DATA ascii\n0 0 1\n";
  }

  TemporaryFolder folder_;
};

TEST_F(CloudFile, ofAllPcdKindsGivesTheSamePoints)
{
  const auto cloud = threeByTwo();
  pcl::io::savePCDFileASCII(folder_.file("a.pcd"), cloud);
  pcl::io::savePCDFileBinary(folder_.file("b.pcd"), cloud);
  pcl::io::savePCDFileBinaryCompressed(folder_.file("c.pcd"), cloud);
  for (const char* name : {"a.pcd", "b.pcd", "c.pcd"})
  {
    SCOPED_TRACE(name);
    const LoadedCloud loaded = load(name);
    EXPECT_EQ(loaded.cloud.width, 3U);
    EXPECT_EQ(loaded.cloud.height, 2U);
    ASSERT_EQ(loaded.cloud.size(), 6U);
    ASSERT_EQ(loaded.cloud.normals.size(), 6U);
    EXPECT_EQ(loaded.cloud.points[2], Eigen::Vector3f(0.2F, -0.2F, 0.5F));
    EXPECT_EQ(loaded.cloud.normals[2], Eigen::Vector3f(0, 0, -1));
    EXPECT_FALSE(loaded.cloud.points[4].allFinite());
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

TEST_F(CloudFile, mayBePlyAndInMillimetres)
{
  pcl::PointCloud<pcl::PointXYZ> cloud(2, 1);
  cloud[0].getVector3fMap() = Eigen::Vector3f(10, -20, 500);
  cloud[1].getVector3fMap() = Eigen::Vector3f(30, 40, 600);
  pcl::io::savePLYFileASCII(folder_.file("a.ply"), cloud);
  pcl::io::savePLYFileBinary(folder_.file("b.ply"), cloud);
  for (const char* name : {"a.ply", "b.ply"})
  {
    const LoadedCloud loaded = load(name, LengthUnit::kMillimetre);
    ASSERT_EQ(loaded.cloud.size(), 2U);
    EXPECT_TRUE(loaded.cloud.points[0].isApprox(Eigen::Vector3f(0.01F, -0.02F, 0.5F)));
    EXPECT_TRUE(loaded.cloud.normals.empty());
    EXPECT_FALSE(loaded.cloud.organised());
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

TEST_F(CloudFile, warnsOfAUnitThatCannotBe)
{
  pcl::PointCloud<pcl::PointXYZ> cloud(2, 1);
  cloud[0].z = cloud[1].z = 500;
  pcl::io::savePCDFileBinary(folder_.file("a.pcd"), cloud);
  ASSERT_EQ(load("a.pcd").warnings.size(), 1U);
  expectHolds(load("a.pcd").warnings[0], "check that its unit is as stated");
}

TEST_F(CloudFile, warnsOfAViewpointOffTheOrigin)
{
  folder_.write("a.pcd", std::string(kHead) + "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 1 1 0 0 0\n" +
                             "POINTS 1\nDATA ascii\n0 0 1\n");
  ASSERT_EQ(load("a.pcd").warnings.size(), 1U);
  expectHolds(load("a.pcd").warnings[0], "viewpoint");
}

TEST_F(CloudFile, isRefusedWithoutMeasuredPoints)
{
  const std::string nan = "nan nan nan\n";
  expectHolds(errorOf("a.pcd", std::string(kHead) + "WIDTH 2\nHEIGHT 1\n" + kView +
                                   "POINTS 2\nDATA ascii\n" + nan + nan),
              "holds no measured point in front of the camera (2 in all)");
  expectHolds(errorOf("a.pcd", std::string(kHead) + "WIDTH 2\nHEIGHT 1\n" + kView +
                                   "POINTS 2\nDATA ascii\n0 0 0\n0 0 -1\n"),
              "holds no measured point in front of the camera (2 in all)");
  expectHolds(errorOf("a.pcd", std::string(kHead) + "WIDTH 0\nHEIGHT 1\n" + kView +
                                   "POINTS 0\nDATA ascii\n"),
              "a.pcd ");
  expectHolds(errorOf("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n"),
              "a.ply ");
}

TEST_F(CloudFile, isRefusedWithoutTheRightFields)
{
  pcl::PointCloud<pcl::Normal> normals(2, 1);
  pcl::io::savePCDFileBinary(folder_.file("n.pcd"), normals);
  expectHolds(error("n.pcd"), "has no fields x, y, z of type float");
  expectHolds(errorOf("d.pcd",
                      "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
                      "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n0 0 1\n"),
              "has no fields x, y, z of type float");
}

TEST_F(CloudFile, isRefusedIfTooLargeBeforeItIsRead)
{
  pcl::io::savePCDFileBinary(folder_.file("b.pcd"), threeByTwo());
  expectHolds(error("b.pcd", 5), "holds 6 points, more than max_points (5)");
  EXPECT_EQ(load("b.pcd", LengthUnit::kMetre, 6).cloud.size(), 6U);
  expectHolds(errorOf("a.pcd", asciiPcd("WIDTH 4000000000\nHEIGHT 1\nPOINTS 4000000000\n")),
              "more than max_points");
  expectHolds(errorOf("a.pcd", asciiPcd("WIDTH 99999999999999\nHEIGHT 1\nPOINTS 1\n")),
              "its size is out of range");
}

TEST_F(CloudFile, isRefusedIfItsHeaderContradictsItself)
{
  expectHolds(errorOf("a.pcd", asciiPcd("WIDTH 1\nHEIGHT 1\nPOINTS 7\n")),
              "POINTS is not WIDTH times HEIGHT");
  expectHolds(errorOf("a.pcd", std::string(kHead) + "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0\nPOINTS 1\n" +
                                   "DATA ascii\n0 0 1\n"),
              "its VIEWPOINT has not seven numbers");
  expectHolds(errorOf("a.pcd", "hello"), "a line that PCD does not know");
  expectHolds(errorOf("a.pcd", ""), "its header has no line FIELDS");
  expectHolds(
      errorOf("a.pcd",
              "VERSION 0.7\nFIELDS x y z\nSIZE 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT "
              "1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA binary\n"),
      "its FIELDS, SIZE, TYPE and COUNT do not fit together");
  expectHolds(errorOf("a.ply", "ply\n"), "its header has no end");
  expectHolds(errorOf("a.xyz", "0 0 0\n"), "give a .pcd or .ply file");
  expectHolds(error("none.pcd"), "does not exist");
}

TEST_F(CloudFile, isRefusedIfCutOff)
{
  pcl::io::savePCDFileBinary(folder_.file("b.pcd"), threeByTwo());
  pcl::io::savePCDFileBinaryCompressed(folder_.file("c.pcd"), threeByTwo());
  pcl::io::savePLYFileBinary(folder_.file("d.ply"), threeByTwo());
  for (const char* name : {"b.pcd", "c.pcd", "d.ply"})
  {
    const std::string whole = contentOf(folder_.file(name));
    for (std::size_t size = 0; size < whole.size(); size += 7)
    {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(size));
      expectHolds(errorOf(name, whole.substr(0, size)), "is damaged or of another kind");
    }
  }
}

TEST_F(CloudFile, neverDoesMoreThanThrowAnInputError)
{
  pcl::io::savePCDFileASCII(folder_.file("a.pcd"), threeByTwo());
  pcl::io::savePCDFileBinary(folder_.file("b.pcd"), threeByTwo());
  pcl::io::savePCDFileBinaryCompressed(folder_.file("c.pcd"), threeByTwo());
  pcl::io::savePLYFileASCII(folder_.file("d.ply"), threeByTwo());
  pcl::io::savePLYFileBinary(folder_.file("e.ply"), threeByTwo());
  std::mt19937 rng(23);
  for (const char* name : {"a.pcd", "b.pcd", "c.pcd", "d.ply", "e.ply"})
  {
    const std::string whole = contentOf(folder_.file(name));
    for (int trial = 0; trial < 300; ++trial)
    {
      std::string content = whole;
      for (int k = 0; k < 3; ++k)
        content[rng() % content.size()] = static_cast<char>(rng() % 256);
      folder_.write(name, content);
      try
      {
        const PointCloud cloud = load(name).cloud;
        EXPECT_EQ(cloud.size(), cloud.width * cloud.height);
        EXPECT_TRUE(cloud.normals.empty() || cloud.normals.size() == cloud.size());
      }
      catch (const InputError& error)
      {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
      }
    }
  }
}
}  // namespace
}  // namespace ppf_bin_picking

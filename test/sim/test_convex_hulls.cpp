#include "ppf_bin_picking/sim/convex_hulls.hpp"

#include "support/overlap.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace ppf_bin_picking
{
namespace
{
namespace fs = std::filesystem;

/// A flat ring about z: outer radius 20 mm, inner 12 mm, 8 mm high.
TriangleMesh ringMesh()
{
  const auto surface = [](float turn, float along)
  {
    constexpr float kProfile[5][2] = {
        {0.02F, -0.004F}, {0.02F, 0.004F}, {0.012F, 0.004F}, {0.012F, -0.004F}, {0.02F, -0.004F}};
    const auto& corner = kProfile[static_cast<int>(std::lround(along * 4))];
    const float angle_rad = 2 * static_cast<float>(M_PI) * turn;
    return Eigen::Vector3f(corner[0] * std::cos(angle_rad), corner[0] * std::sin(angle_rad),
                           corner[1]);
  };
  return tubeMesh(48, 4, surface);
}

/// How far a point lies outside a convex mesh; negative inside.
float excess(const TriangleMesh& hull, const Eigen::Vector3f& point)
{
  float most = -1;
  for (const auto& [a, b, c] : hull.triangles)
  {
    const Eigen::Vector3f corner = hull.vertices[a];
    const Eigen::Vector3f across = (hull.vertices[b] - corner).cross(hull.vertices[c] - corner);
    if (across.norm() > 0) most = std::max(most, across.normalized().dot(point - corner));
  }
  return most;
}

float excess(const ConvexHulls& hulls, const Eigen::Vector3f& point)
{
  float least = 1;
  for (const TriangleMesh& hull : hulls)
    least = std::min(least, excess(hull, point));
  return least;
}

/// All of the part's surface is covered, and no point of a hull's surface is further outside the
/// part than allowed.
void expectClose(const TriangleMesh& part, const ConvexHulls& hulls, float uncovered_m,
                 float bridged_m)
{
  for (const Eigen::Vector3f& point : surfacePoints(part, 0.002F))
    ASSERT_LT(excess(hulls, point), uncovered_m) << point.transpose();
  const TriangleMesh inside_out = insideOut(part);
  // Turned inside out and put into a box, the space around the part is a solid itself.
  const TriangleMesh around = joined({boxMesh({1, 1, 1}), inside_out});
  const Solid space(around);
  for (const TriangleMesh& hull : hulls)
    for (const Eigen::Vector3f& point : surfacePoints(hull, 0.001F))
      ASSERT_LT(space.depth(point), bridged_m) << point.transpose();
}

TEST(ConvexHulls, leaveAConvexPartWhole)
{
  const TriangleMesh box = boxMesh({0.05F, 0.03F, 0.01F});
  const ConvexHulls hulls = convexHulls(box);
  ASSERT_EQ(hulls.size(), 1U);
  EXPECT_EQ(hulls.front().vertices.size(), 8U);
  expectClose(box, hulls, 1e-5F, 1e-5F);
}

TEST(ConvexHulls, followARoundPartWithFewCorners)
{
  const TriangleMesh sphere = sphereMesh(0.02F);
  const ConvexHulls hulls = convexHulls(sphere);
  ASSERT_EQ(hulls.size(), 1U);
  EXPECT_LE(hulls.front().vertices.size(), 128U);
  expectClose(sphere, hulls, 0.0007F, 1e-5F);
}

TEST(ConvexHulls, keepInnerCorners)
{
  const ConvexHulls hulls = convexHulls(angleMesh());
  EXPECT_GE(hulls.size(), 2U);
  EXPECT_LE(hulls.size(), 3U);
  expectClose(angleMesh(), hulls, 2e-5F, 6e-4F);
}

TEST(ConvexHulls, keepTheHoleOfARing)
{
  const ConvexHulls hulls = convexHulls(ringMesh());
  EXPECT_GT(hulls.size(), 3U);
  EXPECT_GT(excess(hulls, {0, 0, 0}), 0.011F);
  expectClose(ringMesh(), hulls, 0.0002F, 0.0006F);
}

TEST(ConvexHulls, takeShellsThatOverlapForOneBody)
{
  const TriangleMesh cross =
      joined({boxMesh({0.06F, 0.01F, 0.01F}), boxMesh({0.01F, 0.05F, 0.008F})});
  const ConvexHulls hulls = convexHulls(cross);
  EXPECT_LE(hulls.size(), 5U);
  for (const Eigen::Vector3f& point : surfacePoints(cross, 0.002F))
    ASSERT_LT(excess(hulls, point), 2e-4F) << point.transpose();
  EXPECT_GT(excess(hulls, {0.02F, 0.02F, 0}), 0.005F);
}

TEST(ConvexHulls, refuseWhatIsNoBody)
{
  EXPECT_THROW(convexHulls({}), std::invalid_argument);
  EXPECT_THROW(convexHulls(squareMesh(0.1F)), std::invalid_argument);
  EXPECT_THROW(convexHulls(insideOut(angleMesh())), std::invalid_argument);
  TriangleMesh broken = angleMesh();
  broken.triangles[0][0] = 1000;
  EXPECT_THROW(convexHulls(broken), std::invalid_argument);
}

class HullCache : public ::testing::Test
{
protected:
  HullCache() { fs::remove_all(folder_); }
  ~HullCache() override { fs::remove_all(folder_); }

  fs::path onlyFile() const
  {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
    return fs::directory_iterator(folder_)->path();
  }
  static std::string content(const fs::path& file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void write(const fs::path& file, const std::string& bytes)
  {
    std::ofstream(file, std::ios::binary) << bytes;
  }

  fs::path folder_ = fs::path(::testing::TempDir()) / "ppf_hull_cache" / "new";
};

bool same(const ConvexHulls& a, const ConvexHulls& b)
{
  const auto equal = [](const TriangleMesh& x, const TriangleMesh& y)
  { return x.vertices == y.vertices && x.triangles == y.triangles; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

TEST_F(HullCache, givesWhatWasComputed)
{
  const ConvexHulls computed = convexHulls(angleMesh());
  EXPECT_TRUE(same(cachedConvexHulls(angleMesh(), folder_.string()), computed));
  const std::string bytes = content(onlyFile());
  EXPECT_TRUE(same(cachedConvexHulls(angleMesh(), folder_.string()), computed));
  EXPECT_EQ(content(onlyFile()), bytes);
}

TEST_F(HullCache, replacesAFileOfAnotherMesh)
{
  // Whole, but of another mesh.
  cachedConvexHulls(boxMesh({0.03F, 0.02F, 0.01F}), folder_.string());
  const fs::path file = onlyFile();
  const std::string box_bytes = content(file);
  fs::remove(file);
  cachedConvexHulls(angleMesh(), folder_.string());
  const fs::path angle_file = onlyFile();
  write(angle_file, box_bytes);
  EXPECT_TRUE(same(cachedConvexHulls(angleMesh(), folder_.string()), convexHulls(angleMesh())));
  EXPECT_NE(content(angle_file), box_bytes);
}

TEST_F(HullCache, replacesDamagedFiles)
{
  const ConvexHulls hulls = cachedConvexHulls(angleMesh(), folder_.string());
  const fs::path file = onlyFile();
  const std::string whole = content(file);
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 20)
  {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    write(file, changed);
    ASSERT_TRUE(same(cachedConvexHulls(angleMesh(), folder_.string()), hulls)) << "byte " << at;
    ASSERT_EQ(content(file), whole) << "byte " << at;
  }
  for (const std::string& bytes : {std::string(), whole.substr(0, whole.size() / 2), whole + "x"})
  {
    write(file, bytes);
    EXPECT_TRUE(same(cachedConvexHulls(angleMesh(), folder_.string()), hulls));
    EXPECT_EQ(content(file), whole);
  }
}

TEST_F(HullCache, namesAFolderThatCannotBeWritten)
{
  fs::create_directories(folder_.parent_path());
  write(folder_, "a file, no folder");
  try
  {
    cachedConvexHulls(angleMesh(), folder_.string());
    FAIL() << "no error";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos);
  }
}
}  // namespace
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/io/package_path.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace ppf_bin_picking
{
namespace
{
class FindPackage : public testing::Test
{
protected:
  /// A package of this name in a folder.
  std::string add(const std::string& folder, const std::string& name) const
  {
    folder_.write(folder + "/package.xml", "<package><name>" + name + "</name></package>");
    return folder_.file(folder);
  }

  std::string find(const std::string& package, const std::string& roots) const
  {
    EXPECT_EQ(setenv("ROS_PACKAGE_PATH", roots.c_str(), 1), 0);
    return findPackage(package);
  }

  std::string find(const std::string& package) const { return find(package, folder_.file("ws")); }

  TemporaryFolder folder_;
};

TEST_F(FindPackage, looksAlongThePathInItsOrder)
{
  const std::string first = add("ws/checkout", "robots"), second = add("other", "tools");
  add("ws/deep/down/tools", "tools");
  const std::string roots = "/none::" + folder_.file("other") + ":" + folder_.file("ws");
  EXPECT_EQ(find("robots", roots), first);
  EXPECT_EQ(find("tools", roots), second);
  EXPECT_EQ(find("nobody", roots), "");
  EXPECT_EQ(find("robots", ""), "");
}

TEST_F(FindPackage, looksBelowFoldersButNotBelowPackages)
{
  const std::string deep = add("ws/a/b/c/d/parts_of_cell", "parts");
  add("ws/robots", "robots");
  add("ws/robots/test/example", "example");
  EXPECT_EQ(find("parts"), deep);
  EXPECT_EQ(find("example"), "");
}

TEST_F(FindPackage, takesTheNearestToTheTop)
{
  add("ws/a/b/robots", "robots");
  EXPECT_EQ(find("robots"), folder_.file("ws/a/b/robots"));
  add("ws/z/robots", "robots");
  EXPECT_EQ(find("robots"), folder_.file("ws/z/robots"));
}

TEST_F(FindPackage, honoursTheMarksThatRospackKnows)
{
  add("ws/old/robots", "robots");
  folder_.write("ws/old/CATKIN_IGNORE", "");
  add("ws/data/tools", "tools");
  folder_.write("ws/data/rospack_nosubdirs", "");
  add("ws/.hidden/secret", "secret");
  EXPECT_EQ(find("robots"), "");
  EXPECT_EQ(find("tools"), "");
  EXPECT_EQ(find("secret"), "");
}

TEST_F(FindPackage, followsLinksAndEndsWhereTheyGoInCircles)
{
  add("elsewhere/robots", "robots");
  folder_.write("ws/a/file", "");
  std::filesystem::create_directory_symlink(folder_.file("ws"), folder_.file("ws/a/loop"));
  EXPECT_EQ(find("robots"), "");
  std::filesystem::create_directory_symlink(folder_.file("elsewhere"), folder_.file("ws/link"));
  EXPECT_EQ(find("robots"), folder_.file("ws/link/robots"));
}

TEST_F(FindPackage, passesOverWhatCannotBeRead)
{
  folder_.write("ws/a/package.xml/not_a_file", "");
  folder_.write("ws/b/package.xml", "");
  const std::string robots = add("ws/c", "robots");
  EXPECT_EQ(find("robots"), robots);
}

TEST(PackagePath, isResolved)
{
  const PackageFinder finder = [](const std::string& package)
  { return package == "robots" ? "/opt/robots" : ""; };
  EXPECT_TRUE(isPackagePath("package://robots/a.stl"));
  EXPECT_FALSE(isPackagePath("/package://robots/a.stl"));
  EXPECT_EQ(resolvedPackagePath("package://robots/meshes/a.stl", "f", finder),
            "/opt/robots/meshes/a.stl");
  EXPECT_EQ(resolvedPackagePath("package://robots", "f", finder), "/opt/robots");
  EXPECT_EQ(
      inputError([&] { resolvedPackagePath("package://arms/a.stl", "f.yaml: mesh", finder); }),
      "f.yaml: mesh names the package 'arms', which is not found: source the workspace that "
      "holds it, or give an absolute path");
}
}  // namespace
}  // namespace ppf_bin_picking

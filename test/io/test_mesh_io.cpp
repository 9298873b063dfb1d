#include "ppf_bin_picking/io/mesh_io.hpp"

#include "support/files.hpp"
#include "support/stl_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ppf_bin_picking
{
namespace
{
class MeshFile : public testing::Test
{
protected:
  LoadedMesh load(const std::string& name, const std::string& content) const
  {
    return loadMesh(folder_.write(name, content), LengthUnit::kMillimetre);
  }
  std::string error(const std::string& name, const std::string& content) const
  {
    return inputError([&] { load(name, content); });
  }
  /// Expects the tetrahedron and one warning (besides that of the normals, which text files here
  /// do not state).
  void expectTetrahedron(const std::string& content, const std::string& warning) const
  {
    const LoadedMesh loaded = load("t.stl", content);
    EXPECT_EQ(loaded.mesh.vertices.size(), 4U);
    EXPECT_EQ(loaded.mesh.triangles.size(), 4U);
    ASSERT_FALSE(loaded.warnings.empty());
    expectHolds(loaded.warnings[0], warning);
    expectHolds(loaded.warnings[0], "t.stl ");
  }

  TemporaryFolder folder_;
};

TEST_F(MeshFile, isReadInMetresWithEqualVerticesMerged)
{
  const LoadedMesh text = load("t.stl", textStl(tetrahedron()));
  const LoadedMesh binary = load("b.stl", binaryStl(tetrahedron(), 4));
  ASSERT_EQ(text.mesh.vertices.size(), 4U);
  EXPECT_EQ(text.mesh.triangles.size(), 4U);
  EXPECT_EQ(text.mesh.vertices[0], Eigen::Vector3f(0.001F, 0, 0));
  EXPECT_EQ(meshChecksum(text.mesh), meshChecksum(binary.mesh));
}

TEST_F(MeshFile, ofAnotherUnitOrShapeHasAnotherChecksum)
{
  const std::string path = folder_.write("t.stl", textStl(tetrahedron()));
  const TriangleMesh in_mm = loadMesh(path, LengthUnit::kMillimetre).mesh;
  EXPECT_NE(meshChecksum(in_mm), meshChecksum(loadMesh(path, LengthUnit::kMetre).mesh));
  TriangleMesh rewound = in_mm;
  std::swap(rewound.triangles[2][0], rewound.triangles[2][1]);
  EXPECT_NE(meshChecksum(in_mm), meshChecksum(rewound));
}

TEST_F(MeshFile, mayBeObjOrPly)
{
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n";
  EXPECT_EQ(load("a.obj", obj).mesh.triangles.size(), 3U);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(load("a.PLY", ply).mesh.triangles.size(), 1U);
}

TEST_F(MeshFile, isTakenForBinaryWhateverItsHeaderSays)
{
  EXPECT_TRUE(load("c.stl", binaryStl(tetrahedron(), 4, "COLOR=abc")).mesh.triangles.size() == 4);
  expectTetrahedron(binaryStl(tetrahedron(), 4, "solid part"), "is binary although");
}

TEST_F(MeshFile, isUsedWithAWarningIfWholeButBadlyWritten)
{
  expectTetrahedron(binaryStl(tetrahedron(), 66), "its header counts 66 facets but it holds 4");
  expectTetrahedron(binaryStl(tetrahedron(), 3), "its header counts 3 facets but it holds 4");
  expectTetrahedron(binaryStl(tetrahedron(), 4) + "abc", "has 3 bytes after its last facet");
  expectTetrahedron(textStl(tetrahedron(), ""), "it has no 'endsolid' line at its end");
  expectTetrahedron(textStl(tetrahedron(), "endsolid u\n"), "begins the solid 't' and ends 'u'");
  expectTetrahedron(textStl(tetrahedron()), "a normal that is missing, not finite or not that");
  expectTetrahedron("solid t\n" + textStl(tetrahedron()).substr(8) + "rubbish\n",
                    "STL does not know its word 'rubbish'");
}

TEST_F(MeshFile, isReadWhateverItsNormalsSay)
{
  for (const char* normal : {"facet\n", "facet normal\n", "facet normal nan nan nan\n",
                             "facet normal 1 2\n", "facet normal 1 2 3 4\n"})
  {
    SCOPED_TRACE(normal);
    std::string text = "solid t\n";
    for (const Facet& facet : tetrahedron())
      text += normal + loopText(facet);
    EXPECT_EQ(load("n.stl", text + "endsolid t\n").mesh.triangles.size(), 4U);
  }
}

TEST_F(MeshFile, isSplitWhereAFacetHasMoreCorners)
{
  std::vector<Facet> facets = tetrahedron();
  facets[3].insert(facets[3].begin() + 1, Corner{0, 0.5F, 0});
  expectTetrahedron(textStl(facets), "has more than three corners in 1 of its facets");
}

TEST_F(MeshFile, isRefusedIfAPieceIsLost)
{
  std::vector<Facet> damaged = tetrahedron();
  damaged[1].pop_back();
  expectHolds(error("t.stl", textStl(damaged)), "1 of its facets lack a corner");
  std::vector<Facet> three = tetrahedron();
  three.pop_back();
  expectHolds(error("t.stl", binaryStl(three, 4)), "its header counts 4 facets but it holds 3");
  expectHolds(error("t.stl", textStl(three, "")), "no 'endsolid' line");
  const std::string whole = binaryStl(tetrahedron(), 4);
  expectHolds(error("t.stl", whole.substr(0, whole.size() - 7)), "seems to have lost a part");
}

TEST_F(MeshFile, isUsedWithAWarningIfOpen)
{
  std::vector<Facet> three = tetrahedron();
  three.pop_back();
  const LoadedMesh loaded = load("t.stl", binaryStl(three, 3));
  EXPECT_EQ(loaded.mesh.triangles.size(), 3U);
  expectHolds(loaded.warnings.back(), "is not closed (3 edges");
}

TEST_F(MeshFile, losesTrianglesThatAreNoSurface)
{
  std::vector<Facet> facets = tetrahedron();
  facets.push_back({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  facets.push_back({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}});
  facets.push_back({{0, 0, 0}, {1, 0, 0}, {0, std::nanf(""), 0}});
  facets.push_back({{0, 0, 0}, {1, 0, 0}, {0, HUGE_VALF, 0}});
  facets.push_back(facets[0]);
  const LoadedMesh loaded = load("t.stl", binaryStl(facets, 9));
  EXPECT_EQ(loaded.mesh.triangles.size(), 4U);
  EXPECT_EQ(loaded.mesh.vertices.size(), 4U);
  ASSERT_EQ(loaded.warnings.size(), 3U);
  expectHolds(loaded.warnings[0],
              "has 2 of 9 triangles with a coordinate that is no finite number");
  expectHolds(loaded.warnings[1], "has 2 of 9 triangles without area");
  expectHolds(loaded.warnings[2], "has 1 of 9 triangles twice");
}

TEST_F(MeshFile, isRefusedWithoutSurface)
{
  expectHolds(error("t.stl", ""), "holds no finite surface (it is empty)");
  expectHolds(error("t.stl", "solid\nendsolid\n"), "holds no finite surface (no facet)");
  expectHolds(error("t.stl", "hello"), "begins neither like a text nor like a binary STL");
  expectHolds(error("t.stl", binaryStl({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, 1)),
              "no triangle with an area");
  expectHolds(error("t.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "t.obj");
  expectHolds(error("t.step", "x"), "give an .stl, .obj or .ply file");
  expectHolds(error("t", "x"), "give an .stl, .obj or .ply file");
  expectHolds(inputError([] { loadMesh("/none/t.stl", LengthUnit::kMetre); }), "does not exist");
}

TEST_F(MeshFile, isRefusedIfItIsAsLargeAsATown)
{
  std::vector<Facet> facets = tetrahedron();
  for (Facet& facet : facets)
    for (Corner& corner : facet)
      for (float& coordinate : corner)
        coordinate *= 1e9F;
  expectHolds(error("t.stl", binaryStl(facets, 4)), "check its unit");
}

TEST_F(MeshFile, isRefusedIfPlyIsDamaged)
{
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string end = "end_header\n";
  const auto expectError = [&](const std::string& content, const std::string& part)
  { expectHolds(error("a.ply", content), part); };
  expectError(head + vertices + faces + end + points + "3 0 1 2\n", "it is cut off");
  expectError(head + vertices + faces + end + points + "3 0 1 2\n3 0 1 9\n", "a.ply ");
  expectError(head + vertices + faces + end + points + "3 0 1 2\nface\n", "a word stands");
  expectError(head + vertices + faces, "its header has no end");
  expectError(head + "element vertex\n" + end, "an element in its header has no count");
  expectError(head + "element vertex 3\nproperty half x\n" + end, "the type 'half'");
  expectError("ply\n" + vertices + faces + end, "neither ascii nor binary");
  expectError(head + vertices + end + points, "holds no finite surface");
  expectError("solid\n", "does not begin with 'ply'");
}

TEST_F(MeshFile, givesItsVerticesInOrderAndDoublePrecision)
{
  const float next = std::nextafter(1.0F, 2.0F);  // equal to 1 after rounding to metres
  std::vector<Facet> facets = tetrahedron();
  facets.push_back({{next, 0, 0}, {1, 0, -0.0F}, {0, 1, 0}});
  const std::string path = folder_.write("t.stl", binaryStl(facets, 5));
  const std::vector<Eigen::Vector3d> vertices = loadVertices(path, LengthUnit::kMillimetre);
  const std::vector<Eigen::Vector3d> expected = {
      {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {next, 0, 0}};
  ASSERT_EQ(vertices.size(), expected.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
    EXPECT_EQ(vertices[i], 0.001 * expected[i]);
  const std::string damaged = folder_.write("d.stl", binaryStl(facets, 5).substr(0, 60));
  expectHolds(inputError([&] { loadVertices(damaged, LengthUnit::kMetre); }), "d.stl ");
}

TEST_F(MeshFile, neverDoesMoreThanThrowAnInputError)
{
  std::mt19937 rng(11);
  const std::vector<std::string> originals = {
      textStl(tetrahedron()), binaryStl(tetrahedron(), 4), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "3 0 1 2\n"};
  const std::vector<std::string> names = {"a.stl", "b.stl", "c.obj", "d.ply"};
  for (std::size_t trial = 0; trial < 800; ++trial)
  {
    std::string content = originals[trial % 4];
    for (int k = 0; k < 3; ++k)
      content[rng() % content.size()] = static_cast<char>(rng() % 256);
    if (rng() % 4 == 0) content.resize(rng() % content.size());
    try
    {
      EXPECT_FALSE(load(names[trial % 4], content).mesh.triangles.empty());
    }
    catch (const InputError& error)
    {
      EXPECT_NE(std::string(error.what()).find(names[trial % 4]), std::string::npos);
    }
  }
}
}  // namespace
}  // namespace ppf_bin_picking

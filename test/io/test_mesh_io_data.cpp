#include "ppf_bin_picking/io/mesh_io.hpp"

#include "support/files.hpp"

#include <gtest/gtest.h>

namespace ppf_bin_picking
{
namespace
{
struct Expectation
{
  const char* file;
  std::size_t triangles;  ///< 0: refused.
  const char* message;    ///< Part of the error or of the first warning.
};

/// docs/bad_input.md shows the same list with the whole messages.
const Expectation kBrokenMeshes[] = {
    {"empty.stl", 0, "holds no finite surface (it is empty)"},
    {"faceless.ascii.stl", 0, "holds no finite surface (no facet)"},
    {"fourVertices.ascii.stl", 4, "has more than three corners in 1 of its facets"},
    {"incorrectFaceCounter.bin.stl", 4, "its header counts 66 facets but it holds 4"},
    {"missingEndsolid.ascii.stl", 4, "no 'endsolid' line"},
    {"missingFace.ascii.stl", 3, "is not closed (3 edges"},
    {"missingNormal.ascii.stl", 4, "states for 1 of 4 triangles a normal that is missing"},
    {"notANumberNormal.ascii.stl", 4, "states for 1 of 4 triangles a normal that is missing"},
    {"quad.ascii.stl", 4, "has more than three corners in 1 of its facets"},
    {"singleFace.ascii.stl", 1, "is not closed (3 edges"},
    {"solidNameMismatch.ascii.stl", 4, "and ends 'anything but tetrahedron'"},
    {"twoVertices.ascii.stl", 0, "1 of its facets lack a corner, and the surface is not closed"},
    {"wrongHeader.bin.stl", 12, "is binary although its header begins with 'solid'"},
    {"wrongNormal.ascii.stl", 4, "states for 1 of 4 triangles a normal"},
    {"wrongNormals.ascii.stl", 4, "states for 4 of 4 triangles a normal"},
};

TEST(BrokenMeshes, areEachRefusedOrUsedWithAWarning)
{
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry :
       std::filesystem::directory_iterator(dataFile("broken_meshes")))
    ++files;
  EXPECT_EQ(files, std::size(kBrokenMeshes));
  for (const Expectation& expected : kBrokenMeshes)
  {
    SCOPED_TRACE(expected.file);
    const std::string path = dataFile("broken_meshes/" + std::string(expected.file));
    if (expected.triangles == 0)
    {
      expectHolds(inputError([&] { loadMesh(path, LengthUnit::kMillimetre); }), expected.message);
      continue;
    }
    const LoadedMesh loaded = loadMesh(path, LengthUnit::kMillimetre);
    EXPECT_EQ(loaded.mesh.triangles.size(), expected.triangles);
    ASSERT_FALSE(loaded.warnings.empty());
    expectHolds(loaded.warnings[0], expected.message);
  }
}

TEST(MeshOfTheRealPin, isReadWholeThoughItsHeaderLooksLikeText)
{
  const LoadedMesh loaded = loadMesh(dataFile("real/pins/pin.stl"), LengthUnit::kMillimetre);
  EXPECT_EQ(loaded.mesh.triangles.size(), 1142U);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(MeshesOfTheBins, areReadWithoutAWarning)
{
  std::size_t meshes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dataFile("bins")))
  {
    const std::string path = (entry.path() / "model.stl").string();
    EXPECT_TRUE(loadMesh(path, LengthUnit::kMillimetre).warnings.empty()) << path;
    ++meshes;
  }
  EXPECT_EQ(meshes, 9U);
}
}  // namespace
}  // namespace ppf_bin_picking

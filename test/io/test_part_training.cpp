#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/part_training.hpp"

#include "support/shapes.hpp"
#include "support/subdivision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
constexpr ModelParameters kCoarse = {0.15, 30};

TEST(TrainPart, saysWhichSymmetriesItFound)
{
  const TrainedPart trained = trainPart({}, boxMesh({0.06F, 0.04F, 0.02F}), kCoarse);
  ASSERT_EQ(trained.notes.size(), 1U);
  EXPECT_NE(trained.notes[0].find("symmetries found in the mesh: "), std::string::npos);
}

TEST(TrainPart, trainsFromASimplifiedMeshAndSaysSo)
{
  const TriangleMesh mesh = subdivided(angleMesh(), 5);
  const TrainedPart trained = trainPart({}, mesh, kCoarse);
  const std::size_t left = trained.model.data().mesh.triangles.size();
  EXPECT_LT(left, 3000U);
  ASSERT_EQ(trained.notes.size(), 2U);
  EXPECT_EQ(trained.notes[0], "mesh simplified from " + std::to_string(mesh.triangles.size()) +
                                  " to " + std::to_string(left) + " triangles");
}

TriangleMesh scaledBox(float scale)
{
  return boxMesh({0.06F * scale, 0.04F * scale, 0.02F * scale});
}

TEST(TrainPart, warnsOfASizeThatNoPartInABinHas)
{
  PartDescription part;
  part.source = "part.yaml";
  const auto warnings = [&](float scale)
  { return trainPart(part, scaledBox(scale), kCoarse).warnings; };
  EXPECT_EQ(warnings(1000), std::vector<std::string>{
                                "part.yaml: the part is 74.8 m across: check its unit (m for mm)"});
  EXPECT_EQ(warnings(0.01F),
            std::vector<std::string>{
                "part.yaml: the part is 0.000748 m across: check its unit (mm for m)"});
  EXPECT_TRUE(warnings(1).empty());
}

TEST(TrainPart, refusesAMeshInMetresThatIsTakenForOneInMillimetres)
{
  try
  {
    trainPart({}, scaledBox(0.001F), kCoarse);
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("check its unit (mm for m)"), std::string::npos);
  }
}

TEST(TrainPart, refusesAStatedSymmetryThatTheMeshHasNot)
{
  PartDescription part;
  part.states_symmetries = true;
  part.symmetries_discrete = {{{{0, 0, 1}, {0, 0, 0}}, 0.5 * M_PI}};
  EXPECT_THROW(trainPart(part, boxMesh({0.06F, 0.04F, 0.02F}), kCoarse), InputError);
}
}  // namespace
}  // namespace ppf_bin_picking

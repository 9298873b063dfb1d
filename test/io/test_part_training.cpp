#include "ppf_bin_picking/io/input_error.hpp"
#include "ppf_bin_picking/io/part_training.hpp"

#include "support/shapes.hpp"
#include "support/subdivision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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

TEST(TrainPart, warnsOfASizeThatNoPartInABinHas)
{
  for (const float scale : {1000.0F, 0.01F})
  {
    const TrainedPart trained =
        trainPart({}, boxMesh({0.06F * scale, 0.04F * scale, 0.02F * scale}), kCoarse);
    ASSERT_EQ(trained.warnings.size(), 1U) << scale;
    EXPECT_NE(trained.warnings[0].find("check the unit"), std::string::npos);
  }
  EXPECT_TRUE(trainPart({}, boxMesh({0.06F, 0.04F, 0.02F}), kCoarse).warnings.empty());
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

#include "ppf_bin_picking/io/part_io.hpp"

#include "support/files.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ppf_bin_picking
{
namespace
{
class PartFile : public testing::Test
{
protected:
  PartDescription load(const std::string& text) const
  {
    return loadPart(folder_.write("clip.yaml", text));
  }
  std::string error(const std::string& text) const
  {
    return inputError([&] { load(text); });
  }

  TemporaryFolder folder_;
};

TEST_F(PartFile, needsNothingButTheUnit)
{
  const PartDescription part = load("unit: mm\n");
  EXPECT_EQ(part.model_id, "clip");
  EXPECT_EQ(part.mesh_file, folder_.file("model.stl"));
  EXPECT_EQ(part.unit, LengthUnit::kMillimetre);
  EXPECT_EQ(part.symmetries().motions().size(), 1U);
  EXPECT_TRUE(part.picks.empty());
  EXPECT_TRUE(part.model_file.empty());
  EXPECT_TRUE(part.detector.empty());
}

TEST_F(PartFile, isNamedByItsFolderIfItIsCalledPart)
{
  EXPECT_EQ(loadPart(folder_.write("bolt/part.yaml", "unit: m\n")).model_id, "bolt");
  folder_.write("bolt/scene/camera.yaml", "");
  EXPECT_EQ(loadPart(folder_.file("bolt/scene/../part.yaml")).model_id, "bolt");
  EXPECT_EQ(load("{unit: m, model_id: m8}").model_id, "m8");
}

TEST_F(PartFile, convertsLengthsAndAngles)
{
  const PartDescription part = load(
      "unit: mm\n"
      "symmetries_discrete: [{axis: [0, 0, 2], angle_deg: 180, point: [40, 18, 0]}]\n"
      "symmetries_continuous: [{axis: [1, 0, 0], point: [0, 0, 5]}]\n"
      "picks: [{name: top, pose: [10, 0, -20, 0, 0, 0.70710678, 0.70710678]}]\n");
  ASSERT_EQ(part.symmetries_discrete.size(), 1U);
  EXPECT_NEAR(part.symmetries_discrete[0].angle_rad, M_PI, 1e-12);
  EXPECT_TRUE(part.symmetries_discrete[0].line.point.isApprox(Eigen::Vector3d(0.04, 0.018, 0)));
  EXPECT_TRUE(part.symmetries_discrete[0].line.axis.isApprox(Eigen::Vector3d::UnitZ()));
  ASSERT_EQ(part.symmetries_continuous.size(), 1U);
  EXPECT_TRUE(part.symmetries_continuous[0].point.isApprox(Eigen::Vector3d(0, 0, 0.005)));
  ASSERT_EQ(part.picks.size(), 1U);
  EXPECT_EQ(part.picks[0].name, "top");
  EXPECT_TRUE((part.picks[0].T_model_pick * Eigen::Vector3d(0.01, 0, 0))
                  .isApprox(Eigen::Vector3d(0.01, 0.01, -0.02), 1e-6));
}

TEST_F(PartFile, takesAnAngleForTheFractionOfATurnThatItsDecimalsMean)
{
  const PartDescription part = load(
      "unit: mm\n"
      "symmetries_discrete: [{axis: [0, 0, 1], angle_deg: 51.43}, "
      "{axis: [0, 0, 1], angle_deg: 240}]\n");
  EXPECT_NEAR(part.symmetries_discrete[0].angle_rad, 2 * M_PI / 7, 1e-12);
  EXPECT_NEAR(part.symmetries_discrete[1].angle_rad, 4 * M_PI / 3, 1e-12);
}

TEST_F(PartFile, withoutSymmetriesHasThoseOfItsMesh)
{
  const TriangleMesh box = boxMesh({0.06F, 0.04F, 0.02F});
  const PartSymmetries found = symmetriesOf(load("unit: mm\n"), box);
  EXPECT_EQ(found.group.motions().size(), 4U);
  expectHolds(found.summary, "symmetries found in the mesh: 1/2 turn about ");
  const PartSymmetries none = symmetriesOf(load("{unit: mm, symmetries_discrete: []}"), box);
  EXPECT_EQ(none.group.motions().size(), 1U);
  expectHolds(none.summary, "symmetries stated, and confirmed by the mesh: none");
  EXPECT_EQ(found.warning, "");
  expectHolds(none.warning, "the mesh has symmetries that are not stated, 1/2 turn about ");
}

TEST_F(PartFile, isRefusedIfItsMeshHasNotItsSymmetries)
{
  const PartDescription part =
      load("{unit: mm, symmetries_discrete: [{axis: [0, 0, 1], angle_deg: 90}]}");
  expectHolds(inputError(
                  [&] {
                    symmetriesOf(part, boxMesh({0.06F, 0.04F, 0.02F}));
                  }),
              "the mesh is not symmetric to the 1/4 turn about the axis [0, 0, 1]");
}

TEST_F(PartFile, namesWhatIsWrong)
{
  expectHolds(error("mesh: a.stl\n"), "unit is missing, and a mesh file does not know its own");
  expectHolds(error("unit: inch\n"), "unit is 'inch': give m or mm");
  expectHolds(error("unti: mm\n"), "unknown key 'unti': the nearest known name is 'unit'");
  expectHolds(error("unit: mm\nsymmetries_discrete: [{axis: [0, 0, 0], angle_deg: 90}]\n"),
              "symmetries_discrete[0]: axis has no length");
  for (const std::string angle : {"77", "77.7", "0.5"})
    expectHolds(
        error("unit: mm\nsymmetries_discrete: [{axis: [0, 0, 1], angle_deg: " + angle + "}]\n"),
        "symmetries_discrete[0]: angle_deg is " + angle + ", which no number of turns");
  for (const std::string angle : {"0", "360", "-720"})
    expectHolds(
        error("unit: mm\nsymmetries_discrete: [{axis: [0, 0, 1], angle_deg: " + angle + "}]\n"),
        "symmetries_discrete[0]: angle_deg is " + angle + ", which turns nothing");
  expectHolds(error("unit: mm\nsymmetries_discrete: [{axis: [0, 0, 1], angle_deg: 180}, "
                    "{axis: [1, 0, 0.1], angle_deg: 90}]\n"),
              "the discrete symmetries have no end");
  expectHolds(error("unit: mm\nsymmetries_discrete: [{axis: [0, 0, 1]}]\n"),
              "angle_deg is missing");
  expectHolds(error("unit: mm\nsymmetries_continuous: {axis: [0, 0, 1]}\n"), "a list of mappings");
  expectHolds(error("unit: mm\npicks: [{name: a, pose: [0, 0, 0, 0, 0, 0, 2]}]\n"),
              "picks[0]: pose [x, y, z, qx, qy, qz, qw] has a quaternion of length");
  expectHolds(error("unit: mm\npicks: [{pose: [0, 0, 0, 0, 0, 0, 1]}]\n"), "name is missing");
}

TEST_F(PartFile, mayChangeSettingsWithinTheirRules)
{
  DetectorConfig config;
  config.lambda = 0.25;
  config = load("unit: mm\ndetector: {min_score: 0.7, clustering: greedy}\n").adapted(config);
  EXPECT_EQ(config.min_score, 0.7);
  EXPECT_EQ(config.clustering, Clustering::kGreedy);
  EXPECT_EQ(config.lambda, 0.25);
  EXPECT_EQ(config.min_visible_share, DetectorConfig().min_visible_share);
  expectHolds(error("unit: mm\ndetector: {min_scor: 0.7}\n"),
              "clip.yaml: detector: unknown key 'min_scor': the nearest known name is 'min_score'");
  expectHolds(error("unit: mm\ndetector: {min_score: 7}\n"), "min_score is 7");
}

TEST_F(PartFile, findsMeshesOfPackages)
{
  const std::string text = "{unit: mm, mesh: 'package://robots/meshes/a.stl', model: a.ppf}";
  const std::string path = folder_.write("clip.yaml", text);
  const PartDescription part = loadPart(
      path, [](const std::string& package) { return package == "robots" ? "/opt/robots" : ""; });
  EXPECT_EQ(part.mesh_file, "/opt/robots/meshes/a.stl");
  EXPECT_EQ(part.model_file, folder_.file("a.ppf"));
  expectHolds(inputError([&] { loadPart(path, [](const std::string&) { return ""; }); }),
              "mesh names the package 'robots', which is not found");
}
}  // namespace
}  // namespace ppf_bin_picking

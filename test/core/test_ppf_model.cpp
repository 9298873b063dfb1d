#include "ppf_bin_picking/core/ppf_model.hpp"

#include "support/brute_force.hpp"
#include "support/shapes.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace ppf_bin_picking
{
namespace
{
const Eigen::Vector3f kBox_m(0.06F, 0.04F, 0.03F);

ModelParameters coarse()
{
  ModelParameters parameters;
  parameters.step_rel = 0.1;
  return parameters;
}

PpfModel trained(const TriangleMesh& mesh)
{
  return PpfModel::train(mesh, SymmetryGroup(), coarse());
}

/// Checks that every sample lies on the box about `center` with the outward normal of a face there.
void expectOnBox(const PpfModel& model, const Eigen::Vector3f& center, const Eigen::Vector3f& size)
{
  ASSERT_GT(model.data().points.size(), 50U);
  for (std::size_t i = 0; i < model.data().points.size(); ++i)
  {
    const Eigen::Vector3f p = model.data().points[i] + model.data().center - center;
    const Eigen::Vector3f& n = model.data().normals[i];
    EXPECT_TRUE((p.cwiseAbs().array() <= size.array() / 2 + 1e-5F).all());
    int axis = 0;
    EXPECT_GT(n.cwiseAbs().maxCoeff(&axis), 0.999F);
    EXPECT_NEAR(p[axis], std::copysign(size[axis] / 2, n[axis]), 1e-5);
  }
}

TEST(PpfModelTrain, measuresTheMesh)
{
  const Eigen::Vector3f shift(1, -2, 0.5F);
  const PpfModel model = trained(shifted(boxMesh(kBox_m), shift));
  EXPECT_NEAR(model.diameter(), kBox_m.norm(), 1e-6);
  EXPECT_LT((model.data().center - shift).norm(), 2e-3F * kBox_m.norm());
}

TEST(PpfModelTrain, samplesTheOutsideWithNormalsOutwards)
{
  expectOnBox(trained(boxMesh(kBox_m)), Eigen::Vector3f::Zero(), kBox_m);
}

TEST(PpfModelTrain, leavesOutInnerSurfaces)
{
  const TriangleMesh hollow = joined({boxMesh(kBox_m), insideOut(boxMesh(0.8F * kBox_m))});
  expectOnBox(trained(hollow), Eigen::Vector3f::Zero(), kBox_m);
}

TEST(PpfModelTrain, mendsAWindingInsideOut)
{
  const PpfModel right = trained(boxMesh(kBox_m));
  const PpfModel mended = trained(insideOut(boxMesh(kBox_m)));
  expectOnBox(mended, Eigen::Vector3f::Zero(), kBox_m);
  for (std::size_t i = 0; i < mended.renderable().normals.size(); ++i)
    EXPECT_GT(mended.renderable().normals[i].dot(right.renderable().normals[i]), 0.999F);
}

TEST(PpfModelTrain, samplesASheetOnBothSides)
{
  const PpfModel model = trained(squareMesh(0.03F));
  std::size_t up = 0, down = 0;
  for (const Eigen::Vector3f& normal : model.data().normals)
    ++(normal.z() > 0 ? up : down);
  EXPECT_GT(up, 30U);
  EXPECT_GT(down, 30U);
}

TEST(PpfModelTrain, leavesNoFaceEmpty)
{
  const PpfModel model = trained(boxMesh(kBox_m));
  const double step_m = model.parameters().step_rel * model.diameter();
  std::mt19937 rng(6);
  for (int trial = 0; trial < 300; ++trial)
  {
    const int axis = trial % 3;
    Eigen::Vector3f p = randomPoint(rng, 0.5F).cwiseProduct(kBox_m);
    p[axis] = std::copysign(kBox_m[axis] / 2, p[axis]);
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < model.data().points.size(); ++i)
      if (model.data().normals[i][axis] * p[axis] > 0)
        nearest =
            std::min<double>(nearest, (model.data().points[i] + model.data().center - p).norm());
    EXPECT_LT(nearest, 1.5 * step_m);
  }
}

TEST(PpfModelTrain, putsEveryPairUnderItsKey)
{
  const PpfModel model = trained(bracketMesh());
  const PpfModelData& data = model.data();
  const auto expected = slowTable(data);
  ASSERT_GT(expected.size(), 100U);
  for (std::uint32_t key = 0; key + 1 < data.offsets.size(); ++key)
  {
    std::vector<std::uint32_t> entries(data.entries.begin() + data.offsets[key],
                                       data.entries.begin() + data.offsets[key + 1]);
    std::sort(entries.begin(), entries.end());
    const auto slow = expected.find(key);
    EXPECT_EQ(entries, slow == expected.end() ? std::vector<std::uint32_t>() : slow->second);
  }
}

TEST(PpfModelTrain, givesTheSameModelAgain)
{
  const PpfModel first = trained(bracketMesh());
  const PpfModel again = trained(bracketMesh());
  EXPECT_EQ(first.data().entries, again.data().entries);
  EXPECT_TRUE(first.data().points == again.data().points);
}

/// Expects an exception that names a word.
void expectRefused(const std::function<void()>& action, const std::string& word)
{
  try
  {
    action();
    ADD_FAILURE() << "not refused: " << word;
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(PpfModelTrain, refusesParametersOutOfRange)
{
  const auto train_with = [](double step_rel, int n_angle) {
    return [=] { PpfModel::train(boxMesh(kBox_m), SymmetryGroup(), {step_rel, n_angle}); };
  };
  expectRefused(train_with(0, 30), "step_rel");
  expectRefused(train_with(0.5, 30), "step_rel");
  expectRefused(train_with(std::numeric_limits<double>::quiet_NaN(), 30), "step_rel");
  expectRefused(train_with(0.1, 0), "n_angle");
}

TEST(PpfModelTrain, refusesMeshesWithoutSurface)
{
  expectRefused([] { trained(TriangleMesh()); }, "surface");
  TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  expectRefused([&] { trained(line); }, "surface");
  expectRefused([] { trained({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}); }, "surface");
  TriangleMesh wild = boxMesh(kBox_m);
  wild.vertices[3].y() = std::numeric_limits<float>::infinity();
  expectRefused([&] { trained(wild); }, "finite");
  wild = boxMesh(kBox_m);
  wild.triangles[5][1] = 8;
  expectRefused([&] { trained(wild); }, "vertex");
}

TEST(PpfModelFromData, takesBackWhatItGave)
{
  const PpfModel model = trained(bracketMesh());
  const PpfModel copy{PpfModelData(model.data())};
  EXPECT_EQ(copy.data().entries, model.data().entries);
  EXPECT_EQ(copy.diameter(), model.diameter());
}

TEST(PpfModelFromData, refusesContradictions)
{
  const PpfModelData good = trained(boxMesh(kBox_m)).data();
  const auto expectSpoilt =
      [&](const std::string& word, const std::function<void(PpfModelData&)>& spoil)
  {
    PpfModelData bad = good;
    spoil(bad);
    expectRefused([&] { PpfModel model(std::move(bad)); }, word);
  };
  expectSpoilt("step_rel", [](PpfModelData& d) { d.parameters.step_rel = -1; });
  expectSpoilt("table", [](PpfModelData& d) { d.parameters.n_angle = 20; });
  expectSpoilt("diameter", [](PpfModelData& d) { d.diameter_m = 0; });
  expectSpoilt("diameter", [](PpfModelData& d) { d.diameter_m = INFINITY; });
  expectSpoilt("centre", [](PpfModelData& d) { d.center.x() = NAN; });
  expectSpoilt("points", [](PpfModelData& d) { d.points.clear(); });
  expectSpoilt("normals", [](PpfModelData& d) { d.normals.pop_back(); });
  expectSpoilt("points", [](PpfModelData& d) { d.points.resize(65536); });
  expectSpoilt("offsets", [](PpfModelData& d) { d.entries.pop_back(); });
  expectSpoilt("offsets", [](PpfModelData& d) { d.offsets.front() = 1; });
  expectSpoilt("ascend", [](PpfModelData& d) { d.offsets[5] = d.offsets.back() + 1; });
  expectSpoilt("table", [](PpfModelData& d) { d.offsets.pop_back(); });
  expectSpoilt("entry", [](PpfModelData& d) { d.entries[7] = 0xFFFF0000U; });
  expectSpoilt("vertex", [](PpfModelData& d) { d.mesh.triangles[0][0] = 8; });
  expectSpoilt("finite", [](PpfModelData& d) { d.mesh.vertices[0].z() = NAN; });
}

TEST(PpfModelFromData, refusesPointsAndNormalsThatAreNotFinite)
{
  const PpfModelData good = trained(boxMesh(kBox_m)).data();
  PpfModelData bad = good;
  bad.points[4].x() = NAN;
  EXPECT_THROW(PpfModel model(std::move(bad)), std::invalid_argument);
  bad = good;
  bad.normals[4].x() = NAN;
  EXPECT_THROW(PpfModel model(std::move(bad)), std::invalid_argument);
}
}  // namespace
}  // namespace ppf_bin_picking

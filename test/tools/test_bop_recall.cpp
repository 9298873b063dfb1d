#include "bop_recall.hpp"
#include "support/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ppf_bin_picking
{
namespace
{
constexpr double kTiny = 1e-9;

/// A part with what is needed to judge its poses.
struct Part
{
  Part(const TriangleMesh& surface, const SymmetryGroup& group)
      : symmetries(group), errors(verticesOf(surface), group), mesh(surface)
  {
  }

  static std::vector<Eigen::Vector3d> verticesOf(const TriangleMesh& mesh)
  {
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      vertices.push_back(vertex.cast<double>());
    return vertices;
  }

  SymmetryGroup symmetries;
  PoseErrors errors;
  RenderableMesh mesh;
};

Eigen::Isometry3d at(double x, double y, double z)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// The nearest of the parts in each pixel.
DepthView viewOf(const Part& part, const std::vector<TrueObject>& objects)
{
  DepthView view = {{320, 240, 300, 300, 159.5F, 119.5F}, std::vector<float>(320 * 240, 0.0F)};
  for (const TrueObject& object : objects)
  {
    RenderedPart seen;
    renderPart(part.mesh, object.T_camera_model.cast<float>(), view.camera, seen);
    for (int row = 0; row < seen.height; ++row)
      for (int column = 0; column < seen.width; ++column)
      {
        float& z = view.depth[static_cast<std::size_t>(seen.top + row) * 320 + seen.left + column];
        const float near = seen.depthAt(column, row);
        if (near > 0 && (z == 0 || near < z)) z = near;
      }
  }
  return view;
}

RecalledTargets recalled(const Part& part, const std::vector<TrueObject>& targets,
                         const std::vector<ScoredPose>& poses)
{
  return recalledTargets(poses, targets, part.errors, part.mesh, viewOf(part, targets));
}

/// A square of 100 mm without symmetries, straight ahead, and another one beside it.
const Part kSquare(squareMesh(0.05F), SymmetryGroup());
const std::vector<TrueObject> kSquares = {{at(-0.1, 0, 0.5), 1}, {at(0.1, 0, 0.5), 1}};

ScoredPose found(const Eigen::Isometry3d& pose, double score = 1)
{
  return {pose, score, true};
}

TEST(BopRecall, ofTheTruthTimesItsSymmetriesIsAllTargets)
{
  const TriangleMesh tube =
      tubeMesh(180, 1,
               [](float turn, float rise)
               {
                 const float angle = 2 * static_cast<float>(M_PI) * turn;
                 return Eigen::Vector3f(0.01F * std::cos(angle), 0.01F * std::sin(angle),
                                        0.08F * rise - 0.04F);
               });
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const SymmetryAxis through_x = {x, Eigen::Vector3d::Zero()};
  const std::vector<Part> parts = {
      Part(bracketMesh(), SymmetryGroup()),
      Part(boxMesh({0.03F, 0.05F, 0.08F}),
           SymmetryGroup({{through_x, M_PI}, {{y, Eigen::Vector3d::Zero()}, M_PI}}, {})),
      Part(tube, SymmetryGroup({{through_x, M_PI}}, {SymmetryAxis()})),
      Part(sphereMesh(0.03F), SymmetryGroup({}, {SymmetryAxis(), through_x}))};
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> turn(0, 2 * M_PI);
  const auto random_rotation = [&]
  { return Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng)).normalized(); };
  for (const Part& part : parts)
  {
    std::vector<TrueObject> targets;
    std::vector<ScoredPose> poses;
    for (int i = 0; i < 12; ++i)
    {
      const Eigen::Isometry3d truth =
          at(0.12 * (i % 4 - 1.5), 0.12 * (i / 4 - 1), 0.6) * random_rotation();
      const auto& motions = part.symmetries.motions();
      Eigen::Isometry3d pose = truth * motions[rng() % motions.size()];
      if (part.symmetries.sphere())
        pose.rotate(random_rotation());
      else if (part.symmetries.revolution())
        pose.rotate(Eigen::AngleAxisd(turn(rng), Eigen::Vector3d::UnitZ()));
      targets.push_back({truth, 1});
      poses.push_back(found(pose, turn(rng)));
    }
    std::shuffle(poses.begin(), poses.end(), rng);
    const RecalledTargets all = recalled(part, targets, poses);
    EXPECT_EQ(all.vsd, 12);
    EXPECT_EQ(all.mssd, 12);
    EXPECT_EQ(all.mspd, 12);
  }
}

TEST(BopRecall, countsThresholdsAboveTheError)
{
  // 21 mm off sideways in a part of 141.4 mm: MSSD .1485, below 8 of 10 thresholds (.15 on).
  // MSPD 300 * .021 / .5 = 12.6 px; thresholds are multiples of 2.5 px, of which 12.5 is below.
  const RecalledTargets one = recalled(kSquare, kSquares, {found(at(-0.079, 0, 0.5))});
  EXPECT_NEAR(one.mssd, 0.8, kTiny);
  EXPECT_NEAR(one.mspd, 0.5, kTiny);
  // 60 x 60 pixels; 12 or 13 columns are of one pose alone: error 24/72 or 26/73, three or four of
  // the ten thresholds above for each tolerance.
  EXPECT_NEAR(one.vsd, 0.4, 0.1 + kTiny);
}

TEST(BopRecall, ofADepthErrorDependsOnTheToleranceOfVsd)
{
  // 10 mm nearer: MSSD .0707; distances differ by 10 to 10.4 mm, 7.1 to 7.4 % of the diameter, so
  // that 9 of 10 tolerances let it pass. The outline grows by 2 %, the area by 4 %.
  const RecalledTargets one = recalled(kSquare, kSquares, {found(at(-0.1, 0, 0.49))});
  EXPECT_NEAR(one.mssd, 0.9, kTiny);
  EXPECT_NEAR(one.vsd, 0.9, 0.09 + kTiny);
}

TEST(BopRecall, givesEachTargetAndEachPoseOnce)
{
  const RecalledTargets one =
      recalled(kSquare, kSquares, {found(at(-0.1, 0, 0.5)), found(at(-0.1, 0, 0.5), 0.5)});
  EXPECT_EQ(one.vsd, 1);
  EXPECT_EQ(one.mssd, 1);
  EXPECT_EQ(one.mspd, 1);
}

TEST(BopRecall, givesTheFreeTargetToTheNextPose)
{
  // Two targets 20 mm (.1414) apart. The better pose takes the nearer one; the second pose lies on
  // it too, and takes the other one where the threshold allows: .15 to .50.
  const std::vector<TrueObject> close = {{at(0, 0, 0.5), 1}, {at(0.02, 0, 0.5), 1}};
  const RecalledTargets both =
      recalled(kSquare, close, {found(at(0, 0, 0.5), 0.1), found(at(0, 0, 0.5), 0.2)});
  EXPECT_NEAR(both.mssd, 1.8, kTiny);
}

TEST(BopRecall, passesOverWhatIsNotRigidAndNeedsNothing)
{
  ScoredPose scaled = found(at(-0.1, 0, 0.5));
  scaled.T_camera_model.matrix()(1, 1) = 2;
  EXPECT_EQ(recalled(kSquare, kSquares, {scaled}).mssd, 0);
  EXPECT_EQ(recalled(kSquare, kSquares, {}).vsd, 0);
  EXPECT_EQ(recalled(kSquare, {}, {found(at(0, 0, 0.5))}).vsd, 0);
}
}  // namespace
}  // namespace ppf_bin_picking

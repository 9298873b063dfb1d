#include "ppf_bin_picking/core/model_renderer.hpp"

#include "support/shapes.hpp"
#include "support/slow_ray_caster.hpp"
#include "support/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
RenderedPart rendered(const TriangleMesh& mesh, const Eigen::Isometry3d& T_camera_mesh,
                      const PinholeCamera& camera = smallCamera())
{
  RenderedPart view;
  renderPart(RenderableMesh(mesh), T_camera_mesh.cast<float>(), camera, view);
  return view;
}

/// Depth at a pixel of the image; 0 outside the window, too.
float depthAtPixel(const RenderedPart& view, int u, int v)
{
  const int column = u - view.left, row = v - view.top;
  if (column < 0 || row < 0 || column >= view.width || row >= view.height) return 0;
  return view.depthAt(column, row);
}

Eigen::Vector3d rayOf(const PinholeCamera& camera, double u, double v)
{
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0};
}

std::size_t coveredPixels(const RenderedPart& view)
{
  return static_cast<std::size_t>(
      std::count_if(view.depth.begin(), view.depth.end(), [](float z) { return z > 0; }));
}

/// Where along z a ray first meets a box about the origin of its frame [m]; 0: never. By slabs.
double boxDepth(const Eigen::Vector3d& half_m, const Eigen::Isometry3d& T_box_camera,
                const Eigen::Vector3d& ray)
{
  const Eigen::Array3d origin = T_box_camera.translation().array();
  const Eigen::Array3d direction = (T_box_camera.linear() * ray).array();
  const Eigen::Array3d one = (-half_m.array() - origin) / direction;
  const Eigen::Array3d other = (half_m.array() - origin) / direction;
  const double enters = one.min(other).maxCoeff(), leaves = one.max(other).minCoeff();
  return enters <= leaves ? enters : 0.0;
}

/// Compares every pixel of an image with the ray caster: depth within 1e-5 of it, and the triangle
/// that it met. A pixel whose ray passes an edge by less than 0.01 px may fall to either side.
void expectAsRayCast(const TriangleMesh& mesh, const Eigen::Isometry3d& T_camera_mesh)
{
  const PinholeCamera camera{80, 60, 150, 150, 39.5F, 29.5F};
  const RenderedPart view = rendered(mesh, T_camera_mesh, camera);
  const TriangleMesh placed = transformed(mesh, T_camera_mesh);
  int differ = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
    {
      const float z = depthAtPixel(view, u, v);
      const std::size_t pixel = static_cast<std::size_t>(v - view.top) * view.width + u - view.left;
      bool agrees = false;
      for (const auto& [du, dv] :
           {std::pair{0.0, 0.0}, {0.01, 0.003}, {-0.01, -0.003}, {0.003, -0.01}, {-0.003, 0.01}})
      {
        const auto hit =
            slowNearestHit(placed, Eigen::Vector3d::Zero(), rayOf(camera, u + du, v + dv));
        const bool same_depth =
            hit ? z > 0 && std::abs(z - hit->distance) < 1e-3 * hit->distance : z == 0;
        agrees = agrees || (same_depth && (!hit || view.triangle[pixel] == hit->triangle));
      }
      differ += agrees ? 0 : 1;
    }
  EXPECT_EQ(differ, 0);
}

TEST(RenderPart, drawsASphereWhereGeometrySaysItIs)
{
  constexpr double kRadius_m = 0.04;
  const PinholeCamera camera = smallCamera();
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0, 0, 0.5), Eigen::Vector3d(0.05, -0.03, 0.6),
        Eigen::Vector3d(-0.02, 0.04, 0.4)})
  {
    SCOPED_TRACE(center.transpose());
    const RenderedPart view =
        rendered(sphereMesh(static_cast<float>(kRadius_m)), poseOf(0.5, {1, 2, 3}, center), camera);
    int seen = 0;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
      {
        const Eigen::Vector3d ray = rayOf(camera, u, v);
        const double along = center.dot(ray) / ray.squaredNorm();
        const double beside = (center - along * ray).norm();
        const float z = depthAtPixel(view, u, v);
        if (beside > kRadius_m)
        {
          EXPECT_EQ(z, 0);
        }
        if (beside > 0.95 * kRadius_m) continue;
        const double half_chord = std::sqrt(kRadius_m * kRadius_m - beside * beside);
        const double expected = along - half_chord / ray.norm();
        EXPECT_GE(z, expected - 1e-6);
        EXPECT_LE(z, expected + kRadius_m / 1600 * kRadius_m / half_chord + 1e-6);
        ++seen;
      }
    EXPECT_GT(seen, 4000);
  }
}

TEST(RenderPart, drawsAPlaneExactlyAtAnySlant)
{
  const PinholeCamera camera = smallCamera();
  for (const double slant_rad : {0.0, 0.5, 1.0, 1.4, 2.4})
  {
    SCOPED_TRACE(slant_rad);
    const Eigen::Isometry3d T_camera_square = poseOf(slant_rad, {1, 0.4, 0}, {0.01, 0.02, 0.6});
    const RenderedPart view = rendered(squareMesh(0.05F), T_camera_square, camera);
    ASSERT_GT(coveredPixels(view), 500U);
    const Eigen::Vector3d normal = T_camera_square.linear().col(2);
    for (int row = 0; row < view.height; ++row)
      for (int column = 0; column < view.width; ++column)
      {
        if (view.depthAt(column, row) == 0) continue;
        const Eigen::Vector3d ray = rayOf(camera, view.left + column, view.top + row);
        const double expected = normal.dot(T_camera_square.translation()) / normal.dot(ray);
        EXPECT_NEAR(view.depthAt(column, row), expected, 3e-6);
        const auto triangle = view.triangle[static_cast<std::size_t>(row) * view.width + column];
        EXPECT_LT((view.normals[triangle].cast<double>() - normal).norm(), 1e-5);
      }
  }
}

TEST(RenderPart, drawsABoxWithTheFacesThatFaceTheCamera)
{
  std::mt19937 rng(17);
  const Eigen::Vector3f size_m(0.08F, 0.05F, 0.03F);
  const PinholeCamera camera = smallCamera();
  for (int trial = 0; trial < 10; ++trial)
  {
    SCOPED_TRACE(trial);
    Eigen::Isometry3d T_camera_box = randomPose(rng, 0.03);
    T_camera_box.translation().z() += 0.5;
    const RenderedPart view = rendered(boxMesh(size_m), T_camera_box, camera);
    int wrong = 0, seen = 0;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
      {
        const double expected =
            boxDepth(0.5 * size_m.cast<double>(), T_camera_box.inverse(), rayOf(camera, u, v));
        wrong += std::abs(depthAtPixel(view, u, v) - expected) > 1e-5 ? 1 : 0;
        seen += expected > 0 ? 1 : 0;
      }
    EXPECT_GT(seen, 1000);
    EXPECT_LE(wrong, 2) << "rounding may move a pixel over the silhouette, rarely";
  }
}

TEST(RenderPart, agreesWithARayCasterOnDepthAndTriangleWhereSurfacesHideEachOther)
{
  std::mt19937 rng(23);
  for (int trial = 0; trial < 8; ++trial)
  {
    SCOPED_TRACE(trial);
    Eigen::Isometry3d T_camera_mesh = randomPose(rng, 0.02);
    T_camera_mesh.translation().z() += 0.25;
    expectAsRayCast(angleMesh(), T_camera_mesh);
    expectAsRayCast(joined({squareMesh(0.05F), shifted(squareMesh(0.03F), {0.01F, 0, 0.03F}),
                            shifted(insideOut(squareMesh(0.02F)), {0, 0.02F, -0.02F})}),
                    T_camera_mesh);
  }
}

TEST(RenderPart, clipsThePartToTheImage)
{
  const PinholeCamera camera{100, 80, 300, 300, 49.5F, 39.5F};
  constexpr int kBorder_px = 150;  // the same camera with more around it
  const PinholeCamera larger{
      camera.width + 2 * kBorder_px, camera.height + 2 * kBorder_px, 300, 300,
      camera.cx + kBorder_px,        camera.cy + kBorder_px};
  int clipped = 0;
  for (const double x : {-0.12, -0.06, 0.0, 0.06, 0.12})
    for (const double y : {-0.1, -0.05, 0.05, 0.1})
    {
      SCOPED_TRACE(::testing::Message() << x << " " << y);
      const Eigen::Isometry3d T_camera_mesh = poseOf(0.8, {1, 2, 0}, {x, y, 0.4});
      const RenderedPart part = rendered(bracketMesh(), T_camera_mesh, camera);
      const RenderedPart whole = rendered(bracketMesh(), T_camera_mesh, larger);
      if (part.width > 0)
      {
        EXPECT_GE(part.left, 0);
        EXPECT_GE(part.top, 0);
        EXPECT_LE(part.left + part.width, camera.width);
        EXPECT_LE(part.top + part.height, camera.height);
      }
      clipped += coveredPixels(part) < coveredPixels(whole) ? 1 : 0;
      int wrong = 0;
      for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u)
          wrong += std::abs(depthAtPixel(part, u, v) -
                            depthAtPixel(whole, u + kBorder_px, v + kBorder_px)) > 1e-5
                       ? 1
                       : 0;
      EXPECT_LE(wrong, 2);
    }
  EXPECT_GT(clipped, 10);
}

TEST(RenderPart, drawsNothingOfAPartBesideTheImageOrBehindTheCamera)
{
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(1, 0, 0.5), Eigen::Vector3d(-1, 0, 0.5), Eigen::Vector3d(0, 1, 0.5),
        Eigen::Vector3d(0, -1, 0.5), Eigen::Vector3d(0, 0, -0.5)})
  {
    SCOPED_TRACE(place.transpose());
    const RenderedPart view = rendered(bracketMesh(), poseOf(0.4, {1, 1, 0}, place));
    EXPECT_EQ(view.width, 0);
    EXPECT_EQ(view.height, 0);
    EXPECT_TRUE(view.depth.empty());
  }
}

TEST(RenderPart, leavesOutTrianglesThatReachBehindTheCameraAndDrawsTheRest)
{
  const TriangleMesh box = shifted(boxMesh({0.05F, 0.05F, 0.05F}), {0, 0, 0.5F});
  const TriangleMesh behind = shifted(boxMesh({0.05F, 0.05F, 0.05F}), {0, 0, -0.5F});
  TriangleMesh through;  // from 0.3 m before the camera to 0.3 m behind it
  through.vertices = {{-0.01F, 0.02F, 0.3F}, {0.01F, 0.02F, 0.3F}, {0, 0.02F, -0.3F}};
  through.triangles = {{0, 1, 2}};
  const auto pose = Eigen::Isometry3d::Identity();
  const RenderedPart alone = rendered(box, pose),
                     among = rendered(joined({behind, box, through}), pose);
  ASSERT_GT(coveredPixels(alone), 1000U);
  for (int v = 0; v < smallCamera().height; ++v)
    for (int u = 0; u < smallCamera().width; ++u)
      ASSERT_EQ(depthAtPixel(alone, u, v), depthAtPixel(among, u, v));
}

TEST(RenderPart, remembersNothingOfTheViewBefore)
{
  const RenderableMesh box(boxMesh({0.02F, 0.02F, 0.02F})), bracket(bracketMesh());
  const Eigen::Isometry3f pose = poseOf(0.6, {1, 1, 0}, {0.01, 0.01, 0.5}).cast<float>();
  RenderedPart fresh, reused;
  renderPart(box, pose, smallCamera(), fresh);
  renderPart(bracket, pose, smallCamera(), reused);
  renderPart(box, pose, smallCamera(), reused);
  EXPECT_EQ(fresh.left, reused.left);
  EXPECT_EQ(fresh.top, reused.top);
  EXPECT_EQ(fresh.width, reused.width);
  EXPECT_EQ(fresh.depth, reused.depth);
}

TEST(RenderPart, showsSheetsFromBothSides)
{
  const Eigen::Isometry3d front = poseOf(M_PI, {1, 0, 0}, {0, 0, 0.5});
  const Eigen::Isometry3d back = poseOf(0, {1, 0, 0}, {0, 0, 0.5});
  const std::size_t covered = coveredPixels(rendered(squareMesh(0.04F), front));
  EXPECT_GT(covered, 5000U);
  EXPECT_EQ(coveredPixels(rendered(squareMesh(0.04F), back)), covered);
}

TEST(RenderableMesh, isClosedIfEveryEdgeHasTwoTrianglesWoundAlike)
{
  EXPECT_TRUE(RenderableMesh(angleMesh()).closed);
  EXPECT_TRUE(RenderableMesh(joined({boxMesh({1, 1, 1}), angleMesh()})).closed);
  EXPECT_FALSE(RenderableMesh(squareMesh(1)).closed);
  TriangleMesh open = angleMesh();
  open.triangles.pop_back();
  EXPECT_FALSE(RenderableMesh(open).closed);
  TriangleMesh turned = angleMesh();
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_FALSE(RenderableMesh(turned).closed);
  TriangleMesh doubled = angleMesh();
  doubled.triangles.push_back(doubled.triangles.front());
  EXPECT_FALSE(RenderableMesh(doubled).closed);
}
}  // namespace
}  // namespace ppf_bin_picking

/// @file Meshes of simple shapes.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace ppf_bin_picking
{
/// A square of the xy plane, its normal +z.
inline TriangleMesh squareMesh(float half_side_m)
{
  const float s = half_side_m;
  return {{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A grid over two parameters in [0, 1] that closes in the first one, wound outwards if surface
/// turns left in the first and rises in the second.
template <class Surface>
TriangleMesh tubeMesh(int around, int along, const Surface& surface)
{
  TriangleMesh mesh;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i)
      mesh.vertices.push_back(surface(static_cast<float>(i) / static_cast<float>(around),
                                      static_cast<float>(j) / static_cast<float>(along)));
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i)
    {
      const auto a = static_cast<std::uint32_t>(j * around + i);
      const auto b = static_cast<std::uint32_t>(j * around + (i + 1) % around);
      const auto n = static_cast<std::uint32_t>(around);
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  return mesh;
}

/// A sphere about the origin; the triangles lie at most radius / 1600 inside it.
inline TriangleMesh sphereMesh(float radius_m)
{
  const auto surface = [&](float turn, float rise)
  {
    const float longitude = 2 * static_cast<float>(M_PI) * turn;
    const float latitude = static_cast<float>(M_PI) * (rise - 0.5F);
    const float across = radius_m * std::cos(latitude);
    return Eigen::Vector3f(across * std::cos(longitude), across * std::sin(longitude),
                           radius_m * std::sin(latitude));
  };
  return tubeMesh(128, 64, surface);
}

/// A box about the origin.
inline TriangleMesh boxMesh(const Eigen::Vector3f& size_m)
{
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(size_m.cwiseProduct(Eigen::Vector3f((corner & 1) != 0 ? 0.5F : -0.5F,
                                                                (corner & 2) != 0 ? 0.5F : -0.5F,
                                                                (corner & 4) != 0 ? 0.5F : -0.5F)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A prism of many sides along z, closed.
inline TriangleMesh cylinderMesh(float radius_m, float height_m, std::uint32_t sides)
{
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, -height_m / 2}, {0, 0, height_m / 2}};
  for (std::uint32_t k = 0; k < sides; ++k)
  {
    const auto angle_rad =
        2 * static_cast<float>(M_PI) * static_cast<float>(k) / static_cast<float>(sides);
    const float x = radius_m * std::cos(angle_rad), y = radius_m * std::sin(angle_rad);
    mesh.vertices.emplace_back(x, y, -height_m / 2);
    mesh.vertices.emplace_back(x, y, height_m / 2);
    const std::uint32_t low = 2 + 2 * k, next = 2 + 2 * ((k + 1) % sides);
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
    mesh.triangles.push_back({0, next, low});
    mesh.triangles.push_back({1, low + 1, next + 1});
  }
  return mesh;
}

/// Two boxes at right angles, closed and asymmetric: an L with legs of 60 and 40 mm.
inline TriangleMesh angleMesh()
{
  // Outline of the L in the xz plane, swept along y.
  constexpr float kOutline[6][2] = {{0, 0},           {0, 0.04F},      {0.008F, 0.04F},
                                    {0.008F, 0.008F}, {0.06F, 0.008F}, {0.06F, 0}};
  TriangleMesh mesh;
  for (const float y : {0.0F, 0.03F})
    for (const auto& p : kOutline)
      mesh.vertices.emplace_back(p[0], y, p[1]);
  for (std::uint32_t i = 0; i < 6; ++i)
  {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j + 6, i + 6});
    mesh.triangles.push_back({i, j, j + 6});
  }
  constexpr std::uint32_t kFace[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& f : kFace)
  {
    mesh.triangles.push_back({f[0], f[2], f[1]});
    mesh.triangles.push_back({f[0] + 6, f[1] + 6, f[2] + 6});
  }
  return mesh;
}

/// All triangles of the meshes in one mesh.
inline TriangleMesh joined(const std::vector<TriangleMesh>& meshes)
{
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes)
  {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles)
      all.triangles.push_back({a + first, b + first, c + first});
  }
  return all;
}

/// The mesh at another place.
inline TriangleMesh shifted(TriangleMesh mesh, const Eigen::Vector3f& by_m)
{
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex += by_m;
  return mesh;
}

/// The mesh with every triangle wound the other way.
inline TriangleMesh insideOut(TriangleMesh mesh)
{
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// A bracket that no turn maps onto itself: a plate of 70 x 40 x 8 mm in the xy plane, a wall at
/// one end and a block beside the middle, both on its upper side (+z).
inline TriangleMesh bracketMesh()
{
  return joined({shifted(boxMesh({0.07F, 0.04F, 0.008F}), {0, 0, 0.004F}),
                 shifted(boxMesh({0.008F, 0.04F, 0.03F}), {-0.031F, 0, 0.023F}),
                 shifted(boxMesh({0.02F, 0.012F, 0.014F}), {0.012F, 0.012F, 0.015F})});
}
}  // namespace ppf_bin_picking

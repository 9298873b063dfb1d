/// @file Meshes of many triangles.
#pragma once

#include "ppf_bin_picking/core/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace ppf_bin_picking
{
/// The same surface with each triangle cut into four, some times.
inline TriangleMesh subdivided(TriangleMesh mesh, int times)
{
  for (; times > 0; --times)
  {
    TriangleMesh finer{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b)
    {
      const auto next = static_cast<std::uint32_t>(finer.vertices.size());
      const auto [found, added] = middles.insert({std::minmax(a, b), next});
      if (added) finer.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
      return found->second;
    };
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const std::array<std::uint32_t, 3>& part :
           {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.triangles.push_back(part);
    }
    mesh = finer;
  }
  return mesh;
}
}  // namespace ppf_bin_picking

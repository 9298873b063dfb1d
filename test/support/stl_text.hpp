/// @file A tetrahedron as STL, whole or with faults.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
using Corner = std::array<float, 3>;
using Facet = std::vector<Corner>;

/// The corner tetrahedron of the unit cube, wound outwards.
inline std::vector<Facet> tetrahedron()
{
  const Corner o = {0, 0, 0};
  const Corner x = {1, 0, 0};
  const Corner y = {0, 1, 0};
  const Corner z = {0, 0, 1};
  return {{x, y, z}, {o, x, z}, {o, z, y}, {o, y, x}};
}

/// One facet without its keyword line.
inline std::string loopText(const Facet& facet)
{
  std::string text = "outer loop\n";
  for (const Corner& c : facet)
    text += "vertex " + std::to_string(c[0]) + " " + std::to_string(c[1]) + " " +
            std::to_string(c[2]) + "\n";
  return text + "endloop\nendfacet\n";
}

/// The solid as text, with normals that need not be looked at.
inline std::string textStl(const std::vector<Facet>& facets,
                           const std::string& end = "endsolid t\n")
{
  std::string text = "solid t\n";
  for (const Facet& facet : facets)
    text += "facet normal 0 0 0\n" + loopText(facet);
  return text + end;
}

/// Along the normal of the first three corners.
inline std::array<float, 3> normalOf(const Facet& facet)
{
  std::array<float, 3> a{};
  std::array<float, 3> b{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    a[k] = facet[1][k] - facet[0][k];
    b[k] = facet[2][k] - facet[0][k];
  }
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The solid as binary STL.
inline std::string binaryStl(const std::vector<Facet>& facets, std::uint32_t counter,
                             std::string header = "")
{
  header.resize(80, '\0');
  header.append(reinterpret_cast<const char*>(&counter), sizeof counter);
  for (const Facet& facet : facets)
  {
    const std::array<float, 3> normal = normalOf(facet);
    header.append(reinterpret_cast<const char*>(normal.data()), sizeof normal);
    for (const Corner& corner : facet)
      header.append(reinterpret_cast<const char*>(corner.data()), sizeof corner);
    header.append(2, '\0');
  }
  return header;
}
}  // namespace ppf_bin_picking

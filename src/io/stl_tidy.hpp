/// @file STL files as people's programs write them, made such that an importer cannot go wrong.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// The facets of an STL file, written again without faults.
struct TidyStl
{
  std::string bytes;                  ///< A faultless STL file, binary or text.
  std::size_t facets = 0;             ///< Triangles in it.
  std::vector<std::string> oddities;  ///< What was wrong but cost nothing; parts of sentences.
  std::string loss;                   ///< Why surface may be missing; empty if nothing says so.
};

/// Never throws for bad content: a file that is no STL at all has no facets and says so in `loss`.
TidyStl tidyStl(const std::string& bytes);
}  // namespace ppf_bin_picking

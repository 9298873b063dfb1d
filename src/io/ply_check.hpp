/// @file PLY files looked through before a library reads them: some read past the end of a damaged
/// file, or never come back from it.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace ppf_bin_picking
{
struct PlyContent
{
  std::map<std::string, std::size_t> elements;  ///< How many of each, such as `vertex`, `face`.
  std::string damage;                           ///< Why it is no whole PLY file; empty if it is.
};

/// Walks the header and every element. Never throws for bad content.
PlyContent checkPly(const std::string& bytes);
}  // namespace ppf_bin_picking

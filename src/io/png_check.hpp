/// @file What a PNG file says of itself, without decoding it.
#pragma once

#include <cstdint>
#include <string>

namespace ppf_bin_picking
{
struct PngHeader
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bit_depth = 0;
  int color_type = 0;  ///< 0: grey.
  std::string damage;  ///< Why the file is no whole PNG; empty if it is.
};

/// Walks all chunks and their checksums: a decoder fills what is missing of a damaged file with
/// zeros, or prints.
PngHeader checkPng(const std::string& bytes);
}  // namespace ppf_bin_picking

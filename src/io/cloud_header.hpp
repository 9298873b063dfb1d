/// @file The headers of PCD and PLY files, looked at before a library allocates what they announce.
#pragma once

#include <cstddef>
#include <string>

namespace ppf_bin_picking
{
/// Points of a PLY file. @throw InputError if it is damaged or cut off.
std::size_t plyPoints(const std::string& bytes, const std::string& path);

/// Points of a PCD file. @throw InputError if its header is incomplete or contradicts itself or the
/// file's size.
std::size_t pcdPoints(const std::string& bytes, const std::string& path);
}  // namespace ppf_bin_picking

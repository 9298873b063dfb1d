/// @file Whole files in, whole files out.
#pragma once

#include <cstddef>
#include <string>

namespace ppf_bin_picking
{
/// All bytes of a file.
/// @throw InputError if it cannot be read, or is larger than max_bytes (it is then not read).
std::string readFile(const std::string& path, std::size_t max_bytes);

/// To be called before long work whose result goes into a file.
/// @throw InputError if writeFile() could not write there.
void requireWritable(const std::string& path);

/// Writes a file so that it is either there whole or not at all: beside it first, then renamed. A
/// link stays, and what it names is written; a device, as /dev/null, is written straight.
/// @throw InputError if the folder cannot be written.
void writeFile(const std::string& path, const std::string& bytes);
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/io/file_bytes.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace ppf_bin_picking
{
namespace fs = std::filesystem;
namespace
{
std::string temporaryFor(const std::string& path)
{
  return path + ".part" + std::to_string(getpid());
}

/// Links stay where what they name is written.
std::string behindLinks(const std::string& path)
{
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target.string();
}

/// A device or a pipe, which another file must not replace.
bool isDevice(const std::string& path)
{
  std::error_code ignored;
  return fs::is_other(fs::status(path, ignored));
}

[[noreturn]] void refuse(const std::string& path)
{
  std::error_code ignored;
  if (path.empty()) throw InputError("a file without a name cannot be written: give it one");
  if (fs::is_directory(path, ignored))
    throw InputError(path + " cannot be written: it is a folder; give the name of a file in it");
  throw InputError(path + " cannot be written: check that its folder exists and has room");
}
}  // namespace

std::string readFile(const std::string& path, std::size_t max_bytes)
{
  std::error_code error;
  if (path.empty()) throw InputError("a file without a name cannot be read: give its path");
  if (fs::is_directory(path, error))
    throw InputError(path + " is a folder: give the path of a file");
  if (!fs::exists(path, error)) throw InputError(path + " does not exist: check the path");
  if (!fs::is_regular_file(path, error)) throw InputError(path + " is not a file: check the path");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > max_bytes)
    throw InputError(path + " is larger than the " + std::to_string(max_bytes) +
                     " bytes such a file may have: check that it is the file you mean");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw InputError(path + " cannot be read: check its permissions");
  return bytes;
}

void requireWritable(const std::string& path)
{
  std::error_code ignored;
  if (isDevice(path))
  {
    if (!std::ofstream(path, std::ios::binary | std::ios::app)) refuse(path);
    return;
  }
  const std::string temporary = temporaryFor(behindLinks(path));
  const bool writable = std::ofstream(temporary, std::ios::binary).is_open();
  fs::remove(temporary, ignored);
  if (path.empty() || !writable || fs::is_directory(path, ignored)) refuse(path);
}

void writeFile(const std::string& path, const std::string& bytes)
{
  const bool device = isDevice(path);
  const std::string target = behindLinks(path);
  const std::string written = device ? target : temporaryFor(target);
  std::ofstream stream(written, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::error_code error;
  if (stream && !device) fs::rename(written, target, error);
  if (stream && !error) return;
  if (!device) fs::remove(written, error);
  refuse(path);
}
}  // namespace ppf_bin_picking

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

[[noreturn]] void refuse(const std::string& path)
{
  throw InputError(path + " cannot be written: check that its folder exists and has room");
}
}  // namespace

std::string readFile(const std::string& path, std::size_t max_bytes)
{
  std::error_code error;
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
  const std::string temporary = temporaryFor(path);
  const bool writable = std::ofstream(temporary, std::ios::binary).is_open();
  std::error_code ignored;
  fs::remove(temporary, ignored);
  if (!writable || fs::is_directory(path, ignored)) refuse(path);
}

void writeFile(const std::string& path, const std::string& bytes)
{
  const std::string temporary = temporaryFor(path);
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::error_code error;
  if (stream) fs::rename(temporary, path, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  refuse(path);
}
}  // namespace ppf_bin_picking

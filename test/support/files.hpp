/// @file Files for tests: a folder that goes away with the test, and the data set's folder.
#pragma once

#include "ppf_bin_picking/io/input_error.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace ppf_bin_picking
{
/// A folder of its own, removed at the end.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "ppf_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file, with the folders it lies in, and returns its path.
  std::string write(const std::string& name, const std::string& content) const
  {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  }

private:
  std::filesystem::path path_;
};

inline std::string contentOf(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A file of the data set; fails the test if PPF_BIN_PICKING_DATA does not name its folder.
inline std::string dataFile(const std::string& name)
{
  const char* folder = std::getenv("PPF_BIN_PICKING_DATA");
  if (folder == nullptr || !std::filesystem::is_directory(folder))
    throw std::runtime_error("set PPF_BIN_PICKING_DATA to the folder of the data set");
  return (std::filesystem::path(folder) / name).string();
}

/// The message of the InputError that a call throws; fails the test if it throws none.
template <class Call>
std::string inputError(Call call)
{
  try
  {
    call();
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

/// Expects a text to hold another.
inline void expectHolds(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
}  // namespace ppf_bin_picking

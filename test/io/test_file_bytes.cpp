#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include "support/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>

namespace ppf_bin_picking
{
namespace
{
namespace fs = std::filesystem;

TEST(WriteFile, writesAFileWholeAndLeavesNothingBeside)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("result");
  for (const std::string bytes : {"first, longer", "second"})
  {
    requireWritable(path);
    writeFile(path, bytes);
    EXPECT_EQ(readFile(path, 100), bytes);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path).parent_path()), {}), 1);
}

TEST(WriteFile, writesWhatALinkNames)
{
  const TemporaryFolder folder;
  folder.write("result", "old");
  const std::string link = folder.file("link");
  fs::create_symlink(folder.file("result"), link);
  requireWritable(link);
  writeFile(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(readFile(folder.file("result"), 100), "new");
}

TEST(WriteFile, writesStraightIntoAPipeWhichStaysOne)
{
  const TemporaryFolder folder;
  folder.write("file", "makes the folder");
  const std::string path = folder.file("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const int reader = open(path.c_str(), O_RDWR | O_NONBLOCK);
  requireWritable(path);
  writeFile(path, "bytes");
  std::array<char, 10> bytes{};
  EXPECT_EQ(read(reader, bytes.data(), bytes.size()), 5);
  EXPECT_STREQ(bytes.data(), "bytes");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(path));
}

TEST(WriteFile, refusesWhatCannotBeWritten)
{
  const TemporaryFolder folder;
  folder.write("file", "");
  for (const std::string& path : {folder.file("none/result"), folder.file("."), std::string()})
  {
    EXPECT_THROW(requireWritable(path), InputError) << path;
    EXPECT_THROW(writeFile(path, "bytes"), InputError) << path;
  }
}

TEST(Files, thatAreFoldersOrHaveNoNameAreNamedWithARemedy)
{
  const TemporaryFolder folder;
  const std::string path = folder.file(".");
  EXPECT_EQ(inputError([&] { requireWritable(path); }),
            path + " cannot be written: it is a folder; give the name of a file in it");
  EXPECT_EQ(inputError([] { requireWritable(""); }),
            "a file without a name cannot be written: give it one");
  EXPECT_EQ(inputError([&] { readFile(path, 10); }),
            path + " is a folder: give the path of a file");
  EXPECT_EQ(inputError([] { readFile("", 10); }),
            "a file without a name cannot be read: give its path");
}
}  // namespace
}  // namespace ppf_bin_picking

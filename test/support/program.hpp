/// @file Running programs as a person does.
#pragma once

#include "support/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

extern char** environ;

namespace ppf_bin_picking
{
/// How a program ended and what it printed.
struct Outcome
{
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a program. What it prints goes through files of the folder.
inline Outcome runProgram(const std::string& program, std::vector<std::string> arguments,
                          const TemporaryFolder& folder)
{
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int flags = O_CREAT | O_WRONLY | O_TRUNC;
  const std::string out = folder.file("stdout");
  const std::string err = folder.file("stderr");
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
  pid_t child = 0;
  const int error = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot run " + program);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(out), contentOf(err)};
}

/// Runs a tool that stands beside the test.
inline Outcome runBuiltTool(const std::string& tool, const std::vector<std::string>& arguments,
                            const TemporaryFolder& folder)
{
  const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return runProgram((here / tool).string(), arguments, folder);
}

/// Expects exit status 2 and one line on stderr that begins with the tool's name and holds a text.
inline void expectRefusal(const Outcome& outcome, const std::string& tool, const std::string& part)
{
  SCOPED_TRACE(tool + " " + part);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.find(tool + ": "), 0U) << outcome.err;
  expectHolds(outcome.err, part);
}
}  // namespace ppf_bin_picking

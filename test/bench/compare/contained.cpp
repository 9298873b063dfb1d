#include "contained.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace ppf_bin_picking
{
namespace
{
constexpr int kThrown = 3;

/// Never returns: what was open in the parent is not the child's to close.
[[noreturn]] void runChild(unsigned limit_s, const std::function<void()>& work)
{
  restartLimit(limit_s);
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << std::endl;
    _exit(kThrown);
  }
  _exit(0);
}

std::string failureOf(int status, unsigned limit_s)
{
  if (WIFEXITED(status))
  {
    const int code = WEXITSTATUS(status);
    if (code == 0) return "";
    return code == kThrown ? "threw an exception" : "ended with status " + std::to_string(code);
  }
  const int signal = WTERMSIG(status);
  if (signal == SIGALRM) return "took over " + std::to_string(limit_s) + " s";
  return std::string("crashed: ") + strsignal(signal);
}
}  // namespace

std::string runContained(unsigned limit_s, const std::function<void()>& work)
{
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (child == 0) runChild(limit_s, work);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error(std::string("waitpid: ") + std::strerror(errno));
  return failureOf(status, limit_s);
}

double peakMemory_mb()
{
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0)
    throw std::runtime_error(std::string("getrusage: ") + std::strerror(errno));
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void restartLimit(unsigned limit_s)
{
  std::signal(SIGALRM, SIG_DFL);
  alarm(limit_s);
}
}  // namespace ppf_bin_picking

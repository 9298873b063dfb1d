#include "ppf_bin_picking/core/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ppf_bin_picking
{
namespace
{
TEST(ParallelFor, visitsEveryIndexOnce)
{
  for (const int threads : {0, 1, 2, 4})
    for (const std::size_t count : {0U, 1U, 1000U})
    {
      std::vector<int> visits(count, 0);
      parallelFor(threads, count, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(ParallelFor, throwsWhatABodyThrows)
{
  const auto body = [](std::size_t i)
  {
    if (i == 70) throw std::runtime_error("seventy");
  };
  EXPECT_THROW(parallelFor(2, 100, body), std::runtime_error);
}

TEST(ParallelFor, runsAsManyThreadsAsAskedWhateverTheCores)
{
  constexpr int kThreads = 4;
  std::atomic<int> arrived{0};
  const Deadline deadline(30);
  const auto wait_for_all = [&](std::size_t)
  {
    ++arrived;
    while (arrived < kThreads && !deadline.passed())
      std::this_thread::yield();
  };
  parallelFor(kThreads, kThreads, wait_for_all);
  EXPECT_FALSE(deadline.passed());
  EXPECT_EQ(arrived, kThreads);
}

TEST(Deadline, passesOnlyIfThereIsOne)
{
  EXPECT_FALSE(Deadline().passed());
  EXPECT_FALSE(Deadline(0).passed());
  EXPECT_FALSE(Deadline(1000).passed());
  const Deadline soon(1e-4);
  while (!soon.passed())
  {
  }
  EXPECT_TRUE(soon.passed());
}
}  // namespace
}  // namespace ppf_bin_picking

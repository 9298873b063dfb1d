/// @file Loops over indices on several threads.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace ppf_bin_picking
{
/// Calls body(i) for every i in [0, count), in any order and on several threads. Each call may
/// write only what belongs to its index: then the result is the same for any number of threads.
/// @param threads  0: one per core.
/// @throw what a body throws.
void parallelFor(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

/// When to begin no new work: after a point in time, on the steady clock, or when told to stop.
class Deadline
{
public:
  /// Never passes.
  Deadline() = default;

  /// @param seconds_from_now  0: never.
  /// @param stop              Outlives the deadline; once true it has passed. Null: not looked at.
  explicit Deadline(double seconds_from_now, const std::atomic<bool>* stop = nullptr) : stop_(stop)
  {
    using std::chrono::steady_clock;
    if (seconds_from_now > 0)
      end_ = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                       std::chrono::duration<double>(seconds_from_now));
  }

  bool passed() const
  {
    return (stop_ != nullptr && *stop_) || (end_ && std::chrono::steady_clock::now() >= *end_);
  }

private:
  const std::atomic<bool>* stop_ = nullptr;
  std::optional<std::chrono::steady_clock::time_point> end_;
};
}  // namespace ppf_bin_picking

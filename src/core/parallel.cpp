#include "ppf_bin_picking/core/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>

namespace ppf_bin_picking
{
void parallelFor(int threads, std::size_t count, const std::function<void(std::size_t)>& body)
{
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = threads > 0 ? threads : cores;
  // TBB gives no more threads than cores unless told so. The permission holds for the whole process
  // and the smallest one wins, so that fewer threads are asked for by the arena alone.
  std::optional<tbb::global_control> permission;
  if (wanted > cores)
    permission.emplace(tbb::global_control::max_allowed_parallelism,
                       static_cast<std::size_t>(wanted));
  tbb::task_arena arena(wanted);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}
}  // namespace ppf_bin_picking

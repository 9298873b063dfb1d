#include "ppf_bin_picking/core/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ppf_bin_picking
{
void parallelFor(int threads, std::size_t count, const std::function<void(std::size_t)>& body)
{
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}
}  // namespace ppf_bin_picking

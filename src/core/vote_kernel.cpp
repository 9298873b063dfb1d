#include "vote_kernel.hpp"

#include "instruction_sets.hpp"

#include <algorithm>

namespace ppf_bin_picking
{
namespace
{
constexpr std::size_t kBlock = 64;     // numbers that are worked on together
constexpr std::size_t kFarAhead = 16;  // pairs whose offsets are fetched beforehand
constexpr std::size_t kAhead = 8;      // ... and whose entries
}  // namespace

PPF_BIN_PICKING_CLONES
void addVotes(const VoteTable& table, const VoteGrid& grid, std::size_t pairs,
              const std::uint32_t* keys, const std::uint32_t* alphas, const std::uint32_t* weights,
              std::uint32_t* cells)
{
  const std::uint32_t bins = grid.alpha_bins, row_shift = grid.row_shift;
  std::uint32_t places[kBlock];
  for (std::size_t pair = 0; pair < pairs; ++pair)
  {
    if (pair + kAhead < pairs && keys[pair + kAhead] != kNoKey)
      __builtin_prefetch(table.entries + table.offsets[keys[pair + kAhead]]);
    if (keys[pair] == kNoKey) continue;
    const std::uint32_t alpha = alphas[pair], weight = weights[pair];
    const std::uint32_t end = table.offsets[keys[pair] + 1];
    for (std::uint32_t begin = table.offsets[keys[pair]]; begin < end; begin += kBlock)
    {
      const std::uint32_t* const entries = table.entries + begin;
      const std::uint32_t count = std::min<std::uint32_t>(kBlock, end - begin);
      for (std::uint32_t i = 0; i < count; ++i)
        places[i] = ((entries[i] >> 16) << row_shift) +
                    ((((entries[i] - alpha) & (kAlphaTurn - 1)) * bins) >> 16);
      for (std::uint32_t i = 0; i < count; ++i)
        cells[places[i]] += weight;
    }
  }
}

void addBoundaryVotes(const VoteTable& table, std::size_t pairs, const std::uint32_t* keys,
                      std::uint32_t* votes)
{
  for (std::size_t pair = 0; pair < pairs; ++pair)
  {
    if (pair + kFarAhead < pairs && keys[pair + kFarAhead] != kNoKey)
      __builtin_prefetch(table.offsets + keys[pair + kFarAhead]);
    if (pair + kAhead < pairs && keys[pair + kAhead] != kNoKey)
      __builtin_prefetch(table.entries + table.offsets[keys[pair + kAhead]]);
    if (keys[pair] == kNoKey) continue;
    const std::uint32_t* const end = table.entries + table.offsets[keys[pair] + 1];
    for (const std::uint32_t* e = table.entries + table.offsets[keys[pair]]; e != end; ++e)
      ++votes[*e];
  }
}

PPF_BIN_PICKING_CLONES
std::uint32_t largestOf(const std::uint32_t* numbers, std::size_t count)
{
  std::uint32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    largest = std::max(largest, numbers[i]);
  return largest;
}

void collectFrom(std::uint32_t limit, const std::uint32_t* numbers, std::size_t count,
                 std::vector<std::uint32_t>& indices)
{
  for (std::size_t begin = 0; begin < count; begin += kBlock)
  {
    const std::size_t end = std::min(count, begin + kBlock);
    if (largestOf(numbers + begin, end - begin) < limit) continue;
    for (std::size_t i = begin; i < end; ++i)
      if (numbers[i] >= limit) indices.push_back(static_cast<std::uint32_t>(i));
  }
}
}  // namespace ppf_bin_picking

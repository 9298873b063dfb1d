/// @file The counting of votes, on plain arrays; private to the core. No Eigen here:
/// vote_kernel.cpp is compiled for several instruction sets, and the processor's is chosen when the
/// program starts.
#pragma once

#include "ppf_bin_picking/core/pair_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ppf_bin_picking
{
/// A model's table: the entries of key k are entries[offsets[k]] to entries[offsets[k + 1] - 1].
struct VoteTable
{
  const std::uint32_t* offsets;
  const std::uint32_t* entries;
};

/// Where votes are counted: one row a reference point of the model, one cell an alpha bin.
struct VoteGrid
{
  std::uint32_t alpha_bins;
  std::uint32_t row_shift;  ///< A row has 1 << row_shift cells, of which the first are used.
};

/// Adds the votes of pairs: of each entry of its key, (reference point << 16) | alpha, the weight
/// in the cell of the entry's reference point and of the turn from the pair's alpha to the entry's.
/// @param keys, alphas, weights  Of each pair; one with kNoKey has no votes.
void addVotes(const VoteTable& table, const VoteGrid& grid, std::size_t pairs,
              const std::uint32_t* keys, const std::uint32_t* alphas, const std::uint32_t* weights,
              std::uint32_t* cells);

/// Adds one vote for each entry of each pair's key.
/// @param keys   Of each pair; one with kNoKey has no votes.
/// @param votes  One count for each number that an entry can be.
void addBoundaryVotes(const VoteTable& table, std::size_t pairs, const std::uint32_t* keys,
                      std::uint32_t* votes);

/// The largest of some numbers; 0 of none.
std::uint32_t largestOf(const std::uint32_t* numbers, std::size_t count);

/// Appends the indices of the numbers that are not below a limit, in ascending order.
void collectFrom(std::uint32_t limit, const std::uint32_t* numbers, std::size_t count,
                 std::vector<std::uint32_t>& indices);
}  // namespace ppf_bin_picking

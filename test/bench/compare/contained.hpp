/// @file Work in a process of its own, which may crash or never end.
#pragma once

#include <functional>
#include <string>

namespace ppf_bin_picking
{
/// Forks, and runs work in the child. To be called before this process has started a thread: the
/// child has none of them.
/// @param limit_s  After so many seconds of the wall clock the child is killed.
/// @return How the child failed, as a part of a sentence; empty if its work ended.
std::string runContained(unsigned limit_s, const std::function<void()>& work);

/// The most memory that this process has held so far, what it shares with its parent among it [MB].
double peakMemory_mb();

/// Begins the child's time limit again. To be called by work.
void restartLimit(unsigned limit_s);
}  // namespace ppf_bin_picking

/// @file Shares as people read them.
#pragma once

#include <string>

namespace ppf_bin_picking
{
/// `42 %` of 0.42; with more digits `42.0 %`.
std::string percent(double share, int digits = 0);

/// A share that is told beside the limit that it fails. Both in percent, with as many digits, up to
/// three, as it takes to see that they differ.
struct ShareAndLimit
{
  std::string share;
  std::string limit;
};
ShareAndLimit percentBeside(double share, double limit);
}  // namespace ppf_bin_picking

#include "ppf_bin_picking/core/percent.hpp"

#include <sstream>

namespace ppf_bin_picking
{
namespace
{
constexpr int kMostDigits = 3;
}  // namespace

std::string percent(double share, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << 100 * share << " %";
  return text.str();
}

ShareAndLimit percentBeside(double share, double limit)
{
  int digits = 0;
  while (digits < kMostDigits && percent(share, digits) == percent(limit, digits))
    ++digits;
  return {percent(share, digits), percent(limit, digits)};
}
}  // namespace ppf_bin_picking

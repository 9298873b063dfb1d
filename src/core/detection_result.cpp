#include "ppf_bin_picking/core/detection_result.hpp"

namespace ppf_bin_picking
{
const char* toString(UnreliableReason reason)
{
  switch (reason)
  {
    case UnreliableReason::kSpread:
      return "SPREAD";
    case UnreliableReason::kSlippage:
      return "SLIPPAGE";
    case UnreliableReason::kLowScore:
      return "LOW_SCORE";
    case UnreliableReason::kOverlap:
      return "OVERLAP";
    case UnreliableReason::kRunnerUp:
      return "RUNNER_UP";
    case UnreliableReason::kNone:
      break;
  }
  return "";
}
}  // namespace ppf_bin_picking

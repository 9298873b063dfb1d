#include "ppf_bin_picking/core/unreliable_reason.hpp"

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

UnreliableReason reasonOf(ReliabilityTerm term)
{
  switch (term)
  {
    case ReliabilityTerm::kMargin:
      return UnreliableReason::kRunnerUp;
    case ReliabilityTerm::kHold:
    case ReliabilityTerm::kSlideShare:
    case ReliabilityTerm::kGoesOn:
      return UnreliableReason::kSlippage;
    case ReliabilityTerm::kSpread:
      return UnreliableReason::kSpread;
    case ReliabilityTerm::kClaimed:
      return UnreliableReason::kOverlap;
    default:
      return UnreliableReason::kLowScore;
  }
}
}  // namespace ppf_bin_picking

/// @file The package's messages, as `msg::`.
#pragma once

// Message generation puts the messages into the namespace of the package, where the core has a
// struct MismatchRegion of its own. Everything generated is a template in a header, so that another
// namespace changes nothing but the name.
#define ppf_bin_picking ppf_bin_picking_msgs
#include <ppf_bin_picking/Detection.h>
#include <ppf_bin_picking/GetPickablePoses.h>
#undef ppf_bin_picking

namespace ppf_bin_picking_ros
{
namespace msg = ppf_bin_picking_msgs;

using Request = msg::GetPickablePosesRequest;
using Response = msg::GetPickablePosesResponse;
}  // namespace ppf_bin_picking_ros

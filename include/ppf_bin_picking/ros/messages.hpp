/// @file The package's messages, as `msg::`.
#pragma once

#include <ppf_bin_picking/Detection.h>
#include <ppf_bin_picking/GetPickablePoses.h>

namespace ppf_bin_picking_ros
{
namespace msg = ppf_bin_picking;  // where message generation puts them

using Request = msg::GetPickablePosesRequest;
using Response = msg::GetPickablePosesResponse;
}  // namespace ppf_bin_picking_ros

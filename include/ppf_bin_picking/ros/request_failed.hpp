/// @file How a step of a request ends it.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace ppf_bin_picking_ros
{
/// Ends a request with a status below 0. Thrown and caught inside the server only.
class RequestFailed : public std::runtime_error
{
public:
  /// @param status   A status constant of GetPickablePoses.
  /// @param message  One sentence a person can act on.
  RequestFailed(const std::int16_t status, const std::string& message)
      : std::runtime_error(message), status_(status)
  {
  }

  std::int16_t status() const { return status_; }

private:
  std::int16_t status_;
};
}  // namespace ppf_bin_picking_ros

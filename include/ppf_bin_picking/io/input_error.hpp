/// @file What every reader of files throws.
#pragma once

#include <stdexcept>

namespace ppf_bin_picking
{
/// A file, a key or an argument that cannot be used. what() is one sentence that names it and the
/// remedy; it can be shown to a person as it is.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
}  // namespace ppf_bin_picking

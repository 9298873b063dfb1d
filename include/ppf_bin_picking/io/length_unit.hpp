/// @file The unit of a file that does not know its own.
#pragma once

#include <string>

namespace ppf_bin_picking
{
enum class LengthUnit
{
  kMetre,
  kMillimetre,
};

/// Metres in one unit.
constexpr double metres(LengthUnit unit)
{
  return unit == LengthUnit::kMetre ? 1.0 : 0.001;
}

/// Reads `m` or `mm`.
/// @param where  The file and key, or the option; begins the message.
/// @throw InputError naming the word and the allowed ones.
LengthUnit lengthUnitFromString(const std::string& word, const std::string& where);
}  // namespace ppf_bin_picking

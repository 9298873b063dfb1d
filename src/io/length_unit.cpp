#include "ppf_bin_picking/io/length_unit.hpp"

#include "ppf_bin_picking/io/input_error.hpp"

namespace ppf_bin_picking
{
LengthUnit lengthUnitFromString(const std::string& word, const std::string& where)
{
  if (word == "m") return LengthUnit::kMetre;
  if (word == "mm") return LengthUnit::kMillimetre;
  throw InputError(where + " is '" + word + "': give m or mm");
}
}  // namespace ppf_bin_picking

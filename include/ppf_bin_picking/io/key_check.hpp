/// @file Messages about keys of settings, the same for YAML files and for ROS parameters.
#pragma once

#include <string>
#include <vector>

namespace ppf_bin_picking
{
/// The name with the smallest edit distance to a word; empty if there are no names.
std::string nearestName(const std::string& word, const std::vector<std::string>& names);

/// nearestName() if at most a third of the letters differ; otherwise the first name of which the
/// word is the beginning, or the other way round, with four letters at least; otherwise empty.
std::string similarName(const std::string& word, const std::vector<std::string>& names);

/// @param where  The file or parameter namespace that the key stands in.
/// @throw InputError unless the key is one of the names: it names the key and a similar name;
///        without one, all names if they are few.
void requireKnownKey(const std::string& where, const std::string& key,
                     const std::vector<std::string>& names);

/// What a value may be, in words for wrongType().
constexpr const char* kExpectedNumber =
    "a plain decimal number such as 0.35, without quotes, exponent or deg()";
constexpr const char* kExpectedInteger = "a whole number such as 30, without quotes";
constexpr const char* kExpectedBoolean = "true or false, without quotes";
constexpr const char* kExpectedText = "a text";

/// @throw InputError, always: where, key, the value as it stands there and what is expected.
[[noreturn]] void wrongType(const std::string& where, const std::string& key,
                            const std::string& value, const std::string& expected);
}  // namespace ppf_bin_picking

// Numbers as users write and read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/numeric/number_text.h"

namespace vex {

/// A whole number, also written like 1e7 or 2.5e6; throws UsageError where it is not whole, negative, or above 2^64
/// - 1. `option` names it in the message.
std::uint64_t parse_count(std::string_view text, std::string_view option);

/// A finite number; throws UsageError.
double parse_number(std::string_view text, std::string_view option);

/// The same, and above 0.
std::uint64_t parse_positive_count(std::string_view text, std::string_view option);
double parse_positive_number(std::string_view text, std::string_view option);

/// The value of --threads, 1 to 1024; all cores where the text is empty.
int parse_threads(std::string_view text);

/// Value and standard error, the error in units of the last digits shown: 11.0007(10). Two digits of the error.
std::string with_error(double value, double std_error);

/// Up to `digits` significant digits, no trailing zeros.
std::string short_number(double value, int digits = 10);

/// So many digits after the point, without an exponent.
std::string fixed_number(int decimals, double value);

/// 3.2e+06 as 3.2e6.
std::string short_count(double value);

/// Exact: hexadecimal floating point, as a compiler reads it back.
std::string hex_number(double value);

}  // namespace vex

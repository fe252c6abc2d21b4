// Numbers at the end of a text: rows, of which there may be millions.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace vex {

template <class Integer>
void append_integer(std::string& text, Integer value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// The shortest text that reads back as the same double; `none` where it is not finite.
inline void append_number(std::string& text, double value, std::string_view none) {
  if (!std::isfinite(value)) {
    text += none;
    return;
  }
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace vex

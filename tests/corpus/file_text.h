// Bytes of mesh files: put together, and altered.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vex::tests {

// --- numbers

/// The shortest text that is this double.
std::string shortest(double value);
/// As printf has it: "%.4f".
std::string printed(const char* format, double value);

enum class Order : std::uint8_t { little, big };

template <class T>
void put(T value, Order order, std::string* bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  const bool as_here = (std::endian::native == std::endian::little) == (order == Order::little);
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes->push_back(raw[as_here ? i : sizeof(T) - 1 - i]);
}

// --- texts, altered. What they look for must be there: else they throw, and the row fails.

std::string replaced(std::string text, std::string_view what, std::string_view by);  // the first place
std::string replaced_last(std::string text, std::string_view what, std::string_view by);
std::string replaced_all(std::string text, std::string_view what, std::string_view by);  // every place
std::string without(std::string text, std::string_view what);                            // the first place
/// Up to where `what` first begins.
std::string up_to(const std::string& text, std::string_view what);
std::string up_to_last(const std::string& text, std::string_view what);
std::string without_last(std::string bytes, std::size_t n);
/// Of line `number`, from 1: its text, or the file with another.
std::string with_line(const std::string& text, std::size_t number, std::string_view line);
std::string without_line(const std::string& text, std::size_t number);
/// `line` put in behind line `number`; 0: in front of all.
std::string with_line_behind(const std::string& text, std::size_t number, std::string_view line);
/// Put in behind every line.
std::string with_line_behind_every(const std::string& text, std::string_view line);
std::string with_at_every_line_end(const std::string& text, std::string_view what);
std::string with_at_every_line_start(const std::string& text, std::string_view what);
std::string with_byte(std::string bytes, std::size_t at, unsigned value);
std::string in_upper_case(std::string text);

std::string with_crlf(const std::string& text);
std::string with_cr(const std::string& text);
std::string with_bom(const std::string& text);
std::string without_final_newline(std::string text);

// --- what is no mesh

std::string step_text();
std::string medit_text();
std::string html_text();

}  // namespace vex::tests

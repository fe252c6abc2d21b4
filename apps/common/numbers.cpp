#include "apps/common/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"

namespace vex {
namespace {

std::string general(int digits, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value + 0.0);  // -0 reads 0
  return text;
}

[[noreturn]] void not_a(const char* what, std::string_view text, std::string_view option, const char* advice) {
  throw UsageError(std::string("not ") + what + " (\"" + std::string(text) + "\" for " + std::string(option) + ") - " +
                   advice);
}

// Shifts the exponent of a number written as digits, so that "e+06" reads "e6".
std::string tidy_exponent(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digits = e + 1;
  if (text[digits] == '+') {
    text.erase(digits, 1);
  } else if (text[digits] == '-') {
    ++digits;
  }
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  return text;
}

}  // namespace

std::string fixed_number(int decimals, double value) {
  char text[512];  // the largest double has 309 digits before the point
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::uint64_t parse_count(std::string_view text, std::string_view option) {
  const char* const end = text.data() + text.size();
  std::uint64_t count = 0;
  if (const auto [stop, error] = std::from_chars(text.data(), end, count); error == std::errc{} && stop == end) {
    return count;
  }
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool read = error == std::errc{} && stop == end && std::isfinite(value);
  if (!read || value < 0.0 || value != std::floor(value) || value >= 0x1p64) {
    not_a("a count", text, option, "write a whole number, like 10000000 or 1e7");
  }
  return static_cast<std::uint64_t>(value);
}

double parse_number(std::string_view text, std::string_view option) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) {
    not_a("a number", text, option, "write it like 0.5 or 1e-3");
  }
  return value;
}

std::uint64_t parse_positive_count(std::string_view text, std::string_view option) {
  const std::uint64_t value = parse_count(text, option);
  if (value == 0) not_a("positive", text, option, "give a count above 0");
  return value;
}

double parse_positive_number(std::string_view text, std::string_view option) {
  const double value = parse_number(text, option);
  if (!(value > 0.0)) not_a("positive", text, option, "give a number above 0");
  return value;
}

int parse_threads(std::string_view text) {
  constexpr std::uint64_t kMaxThreads = kMostThreads;
  if (text.empty()) {
    return static_cast<int>(std::clamp<std::uint64_t>(std::thread::hardware_concurrency(), 1, kMaxThreads));
  }
  const std::uint64_t n = parse_positive_count(text, "--threads");
  if (n > kMaxThreads)
    throw UsageError("too many threads (" + std::string(text) + ") - at most " + std::to_string(kMaxThreads));
  return static_cast<int>(n);
}

std::string with_error(double value, double std_error) {
  if (!std::isfinite(value) || !std::isfinite(std_error) || std_error <= 0.0) return general(10, value);
  // The decimal place of the error's second digit; an error that rounds up to three digits moves it by one.
  int place = static_cast<int>(std::floor(std::log10(std_error))) - 1;
  if (std::round(std_error / std::pow(10.0, place)) >= 100.0) ++place;
  const int value_exponent = value == 0.0 ? place : static_cast<int>(std::floor(std::log10(std::fabs(value))));
  const bool scientific = place > 0 || value_exponent < -4;
  const int exponent = scientific ? std::max(value_exponent, place + 1) : 0;
  const double error_digits = std::round(std_error / std::pow(10.0, place));
  std::string text = fixed_number(std::max(0, exponent - place), value / std::pow(10.0, exponent)) + "(" +
                     fixed_number(0, error_digits) + ")";
  if (scientific) text += "e" + std::to_string(exponent);
  return text;
}

std::string short_number(double value, int digits) { return tidy_exponent(general(digits, value)); }

std::string short_count(double value) {
  return value < 1e5 ? fixed_number(0, value) : tidy_exponent(general(3, value));
}

std::string hex_number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

}  // namespace vex

#include "apps/common/number_range.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

/// digits * 10^exponent
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
};

constexpr std::int64_t kLargest = 100'000'000'000'000'000;  // 10^17: sums of two, and a step beyond, are no overflow

[[noreturn]] void refuse(const std::string& problem, const std::string& text, const std::string& option,
                         const std::string& advice) {
  throw UsageError(problem + " (\"" + text + "\" for " + option + ") - " + advice);
}

Decimal decimal_of(const std::string& word, const std::string& text, const std::string& option) {
  parse_number(word, option);  // finite, and nothing else in it
  Decimal decimal;
  bool is_negative = false, behind_point = false;
  std::size_t at = 0;
  if (word[at] == '-') {
    is_negative = true;
    ++at;
  }
  int zeros = 0;  // behind the last digit that is none: they count as an exponent
  for (; at < word.size() && word[at] != 'e' && word[at] != 'E'; ++at) {
    if (word[at] == '.') {
      behind_point = true;
      continue;
    }
    if (behind_point) --decimal.exponent;
    if (word[at] == '0') {
      if (decimal.digits != 0) ++zeros;
      continue;
    }
    for (++zeros; zeros > 0; --zeros) {
      decimal.digits *= 10;
      if (decimal.digits >= kLargest) refuse("too many digits", text, option, "give at most 17");
    }
    decimal.digits += word[at] - '0';
  }
  decimal.exponent += zeros;
  if (at < word.size()) decimal.exponent += std::atoi(word.c_str() + at + 1);
  if (is_negative) decimal.digits = -decimal.digits;
  if (decimal.digits == 0) decimal.exponent = 0;
  return decimal;
}

/// In units of 10^exponent, which is no larger than its own.
std::int64_t in_units(Decimal decimal, int exponent, const std::string& text, const std::string& option) {
  for (; decimal.exponent > exponent && decimal.digits != 0; --decimal.exponent) {
    decimal.digits *= 10;
    if (std::abs(decimal.digits) >= kLargest) {
      refuse("numbers too far apart", text, option, "from the largest to the smallest give at most 17 digits");
    }
  }
  return decimal.digits;
}

std::string text_of(std::int64_t digits, int exponent) {
  if (digits == 0) return "0";
  for (; digits % 10 == 0; ++exponent) digits /= 10;
  std::string text = std::to_string(std::abs(digits));
  const int n = static_cast<int>(text.size());
  if (exponent >= 0 && n + exponent <= 17) {
    text.append(static_cast<std::size_t>(exponent), '0');
  } else if (exponent < 0 && -exponent < n) {
    text.insert(static_cast<std::size_t>(n + exponent), ".");
  } else if (exponent < 0 && -exponent <= n + 4) {
    text.insert(0, "0." + std::string(static_cast<std::size_t>(-exponent - n), '0'));
  } else {
    text += "e" + std::to_string(exponent);
  }
  return (digits < 0 ? "-" : "") + text;
}

}  // namespace

std::vector<std::string> numbers_of_range(const std::string& text, const std::string& option) {
  const std::size_t first = text.find(':'), last = text.rfind(':');
  if (first == std::string::npos || first == last || text.find(':', first + 1) != last) {
    refuse("not a range", text, option, "write FROM:TO:STEP, as in 1:20:1");
  }
  const Decimal from = decimal_of(text.substr(0, first), text, option);
  const Decimal to = decimal_of(text.substr(first + 1, last - first - 1), text, option);
  const Decimal step = decimal_of(text.substr(last + 1), text, option);
  if (step.digits == 0) refuse("a step of 0", text, option, "write FROM:TO:STEP with another one");
  int unit = step.exponent;
  for (const Decimal& one : {from, to}) {
    if (one.digits != 0) unit = std::min(unit, one.exponent);
  }
  const std::int64_t begin = in_units(from, unit, text, option), end = in_units(to, unit, text, option),
                     by = in_units(step, unit, text, option);
  if (begin != end && (end > begin) != (by > 0)) {
    refuse("a step that leads away from the end", text, option, "give it the other sign");
  }
  const std::int64_t n_steps = (end - begin) / by;
  if (n_steps >= static_cast<std::int64_t>(kMostCases)) {
    refuse("too many numbers", text, option, "give at most " + std::to_string(kMostCases));
  }
  std::vector<std::string> numbers;
  for (std::int64_t k = 0; k <= n_steps; ++k) numbers.push_back(text_of(begin + k * by, unit));
  return numbers;
}

}  // namespace vex

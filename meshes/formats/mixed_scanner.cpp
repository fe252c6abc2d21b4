#include "meshes/formats/mixed_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr bool is_gap(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Counted from 1.
std::size_t line_at(std::string_view text, std::size_t position) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min(position, text.size()); ++i) {
    const bool is_pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (text[i] == '\n' || (text[i] == '\r' && !is_pair)) ++line;
  }
  return line;
}

}  // namespace

std::string Expected::text() const {
  return number == kNoNumber ? what : what + (" " + std::to_string(number)) + ", counted from 0";
}

MixedScanner::MixedScanner(std::string_view bytes, std::string name, Encoding encoding, std::size_t begin)
    : bytes_(bytes), name_(std::move(name)), at_(begin), begin_of_last_(begin) {
  set_encoding(encoding);
}

void MixedScanner::set_encoding(Encoding encoding) {
  is_text_ = encoding == Encoding::text;
  swapped_ = (encoding == Encoding::big_endian) != (std::endian::native == std::endian::big);
}

void MixedScanner::end_now_and_then_if_interrupted() {
  if (++n_numbers_ % 1024 == 0) end_if_interrupted();
}

std::int64_t MixedScanner::whole_word(const Expected& expected, std::int64_t least, std::int64_t most) {
  end_now_and_then_if_interrupted();
  std::string_view word = next_word();
  const std::string_view shown = word;
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc{} && stop == end && value >= least && value <= most) return value;
  if (word.empty()) refuse("the file ends early", expected.text());
  if (stop != end || error == std::errc::invalid_argument) {
    refuse(quoted(shown) + " is no whole number", expected.text());
  }
  refuse(quoted(shown) + " is out of range",
         expected.text() + (least > most ? ", and there is none"
                                         : ", from " + std::to_string(least) + " to " + std::to_string(most)));
}

std::string_view MixedScanner::rest_of_line() {
  while (at_ < bytes_.size() && is_gap(bytes_[at_])) ++at_;
  begin_of_last_ = at_;
  while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
  std::string_view line = bytes_.substr(begin_of_last_, at_ - begin_of_last_);
  while (!line.empty() && is_gap(line.back())) line.remove_suffix(1);
  if (at_ < bytes_.size()) at_ += bytes_.substr(at_).starts_with("\r\n") ? std::size_t{2} : std::size_t{1};
  return line;
}

void MixedScanner::end_line(const Expected& expected) {
  while (at_ < bytes_.size() && is_gap(bytes_[at_])) ++at_;
  begin_of_last_ = at_;
  const std::string_view rest = bytes_.substr(at_);
  if (rest.starts_with("\r\n")) {
    at_ += 2;
  } else if (rest.starts_with('\n') || (is_text_ && rest.starts_with('\r'))) {
    ++at_;
  } else if (!rest.empty()) {
    std::size_t end = 0;
    while (end < rest.size() && !is_space(rest[end])) ++end;
    refuse(quoted(rest.substr(0, std::max<std::size_t>(end, 1))) + " is left over", expected.text());
  }
}

double MixedScanner::coordinate(ScalarType type, const Expected& expected) {
  if (is_text_ && is_whole(type)) {
    constexpr std::int64_t kMost = std::int64_t{1} << 53;  // every whole number up to here is a double
    const std::int64_t value = whole_word(expected, -kMost, kMost);
    written_.note(bytes_.substr(begin_of_last_, at_ - begin_of_last_), static_cast<double>(value));
    return static_cast<double>(value);
  }
  end_now_and_then_if_interrupted();
  if (is_text_) {
    const std::string_view word = next_word();
    const std::optional<double> value = written_.parse(word);
    if (!value) {
      refuse(word.empty() ? "the file ends early" : quoted(word) + " is no finite decimal number", expected.text());
    }
    return *value;
  }
  const double value = load_number(take(1, size_of(type), expected).data(), type, swapped_);
  if (!std::isfinite(value)) refuse("a coordinate is not finite", expected.text());
  largest_ = std::max(largest_, std::fabs(value));
  any_float_ = any_float_ || type == ScalarType::float32;
  return value;
}

std::int64_t MixedScanner::whole_number(ScalarType type, const Expected& expected, std::int64_t least,
                                        std::int64_t most) {
  if (is_text_) return whole_word(expected, least, most);
  end_now_and_then_if_interrupted();
  const std::int64_t value = load_whole(take(1, size_of(type), expected).data(), type, swapped_);
  if (value >= least && value <= most) return value;
  refuse(std::to_string(value) + " is out of range",
         expected.text() + (least > most ? ", and there is none"
                                         : ", from " + std::to_string(least) + " to " + std::to_string(most)));
}

void MixedScanner::skip(ScalarType type, std::uint64_t n, const Expected& expected) {
  if (!is_text_) {
    take(n, size_of(type), expected);
    return;
  }
  for (std::uint64_t i = 0; i < n; ++i) {
    end_now_and_then_if_interrupted();
    if (next_word().empty()) refuse("the file ends early", expected.text());
  }
}

std::string_view MixedScanner::take(std::uint64_t n, std::size_t size, const Expected& expected) {
  begin_of_last_ = at_;
  const std::size_t left = n_left();
  if (size > 0 && n > left / size) {
    refuse("the file ends early: " + std::to_string(left) + " bytes are left of " + std::to_string(n) + " times " +
               std::to_string(size),
           expected.text());
  }
  const std::string_view result = bytes_.substr(at_, static_cast<std::size_t>(n) * size);
  at_ += result.size();
  return result;
}

CoordinateDigits MixedScanner::digits() const {
  if (is_text_) return written_.digits();
  return any_float_ ? float_digits(largest_) : double_digits(largest_);
}

void MixedScanner::refuse(const std::string& problem, const std::string& expected, const std::string& advice) const {
  if (is_text_) refuse_text(name_, line_at(bytes_, begin_of_last_), problem, expected, advice);
  throw InputError(problem + " (" + name_ + ", byte " + std::to_string(begin_of_last_) + ": expected " + expected +
                   ") - " + advice);
}

}  // namespace vex

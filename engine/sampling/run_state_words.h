// The words of a run's state, each looked at before it is used.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/run_state.h"

namespace vex {

/// The power of two of the last bit of a FixedPointSum, and how many digits of four bits it has.
inline constexpr int kSumExponent = -448;
inline constexpr int kSumDigits = 16 * static_cast<int>(FixedPointSum::Words{}.size());

/// Reads words and numbers one after another, line by line; refuses everything else with the number of the line.
class RunStateWords {
 public:
  static constexpr std::size_t kLongestText = 4096;  // of words that a line ends with
  static constexpr std::uint64_t kMostTrials = std::uint64_t{1} << 62;

  explicit RunStateWords(std::string_view text) : rest_(text) {}

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError("a run's state, line " + std::to_string(line_number_) + ": " + problem +
                     " - it is damaged, or of another version of vex");
  }
  void require(bool condition, const char* problem) const {
    if (!condition) refuse(problem);
  }

  /// The next line, which begins with this word.
  void line(std::string_view key) {
    require(line_.empty(), "more words than it has");
    ++line_number_;
    const std::size_t end = rest_.find('\n');
    require(end != std::string_view::npos, "it is cut off");
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    require(line_.starts_with(key) && (line_.size() == key.size() || line_[key.size()] == ' '),
            "another word stands where it should begin otherwise");
    line_.remove_prefix(key.size());
  }
  /// Whether the next line begins with this word.
  bool has_line(std::string_view key) const { return rest_.starts_with(std::string(key) + ' '); }
  void end() const {
    require(line_.empty(), "more words than it has");
    require(rest_.empty(), "something stands behind its end");
  }

  std::string_view word() {
    require(!line_.empty() && line_.front() == ' ', "a word is missing");
    line_.remove_prefix(1);
    const std::size_t end = std::min(line_.find(' '), line_.size());
    const std::string_view found = line_.substr(0, end);
    line_.remove_prefix(end);
    return found;
  }
  std::string rest_of_line() {
    require(!line_.empty() && line_.front() == ' ' && line_.size() <= kLongestText + 1, "no text, or too long a one");
    const std::string found(line_.substr(1));
    line_ = {};
    return found;
  }

  std::uint64_t count(std::uint64_t most = kMostTrials) {
    const std::uint64_t number = whole<std::uint64_t>(word(), 10);
    require(number <= most, "a number is too large");
    return number;
  }
  double number() {
    const std::string_view digits = word();
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
    require(error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value),
            "no finite number in hexadecimal");
    return value;
  }
  FixedPointSum sum() {
    std::string_view digits = word();
    const bool is_negative = digits.starts_with('-');
    if (is_negative) digits.remove_prefix(1);
    const std::size_t mark = digits.find('p');
    require(mark != std::string_view::npos && mark > 0 && mark <= kSumDigits, "no sum");
    const int exponent = whole<int>(digits.substr(mark + 1), 10);
    require(exponent >= kSumExponent && exponent < kSumExponent + 4 * kSumDigits && exponent % 4 == 0,
            "a sum is too large, or too fine");
    const auto last = static_cast<std::size_t>((exponent - kSumExponent) / 4);
    require(last + mark <= kSumDigits, "a sum is too large");
    FixedPointSum::Words size{};
    for (std::size_t k = 0; k < mark; ++k) {
      const std::size_t place = last + (mark - 1 - k);
      size[place / 16] |= whole<std::uint64_t>(digits.substr(k, 1), 16) << (4 * (place % 16));
    }
    require(size.back() >> 63 == 0, "a sum is too large");  // its last bit is the sign's
    return FixedPointSum(is_negative, size);
  }
  /// Of the half-widths of so many undecided values of an integrand.
  FixedPointSum half_widths(std::uint64_t n) {
    const FixedPointSum found = sum();
    const double value = found.value();
    require(value >= 0.0 && value <= kRounding * static_cast<double>(n) * Integrand::kLargestValue,
            "half-widths that no such number of values has");
    return found;
  }
  /// Of so many shares of 0 to 1.
  ShareSums shares(std::uint64_t n) {
    const ShareSums sums{sum(), sum()};
    require(is_sum_of_shares(sums, n), "sums that no such number of shares has");
    return sums;
  }
  /// Of so many values of an integrand.
  ShareSums values(std::uint64_t n) {
    const ShareSums sums{sum(), sum()};
    const double first = sums.first.value(), second = sums.second.value(), number = static_cast<double>(n);
    constexpr double kLargest = Integrand::kLargestValue, kCut = 0x1p-380;
    require(second >= 0.0 && second <= kRounding * number * (kLargest * kLargest) &&
                std::fabs(first) <= kRounding * number * kLargest &&
                first * first <= kRounding * number * second + number * kCut,
            "sums that no such number of values has");
    return sums;
  }
  Transformd pose() {
    Transformd pose;
    for (Vec3d* const row : {&pose.row_x, &pose.row_y, &pose.row_z, &pose.translation}) {
      for (double* const x : {&row->x, &row->y, &row->z}) *x = number();
    }
    return pose;
  }
  Outcome outcome() { return static_cast<Outcome>(count(2)); }

  /// Reads how many there are, of at most `most`, and each of those that are kept by `read_one`.
  template <class T, class ReadOne>
  void list(FirstOf<T>& list, std::uint64_t most, std::string_view key, const RunState& of, const ReadOne& read_one) {
    list.n_all = count(most);
    const std::uint64_t n_kept = count(FirstOf<T>::kKept);
    require(n_kept == std::min<std::uint64_t>(list.n_all, FirstOf<T>::kKept), "a list of another length");
    for (std::uint64_t k = 0; k < n_kept; ++k) {
      line(key);
      T one;
      one.index = count();
      require(one.index >= of.first_trial && one.index < of.end(), "a trial that is not of this run");
      require(list.kept.empty() || list.kept.back().index < one.index, "trials out of their order");
      read_one(one);
      list.kept.push_back(std::move(one));
    }
  }

 private:
  static constexpr double kRounding = 1.0 + 1e-9;  // of sums of values

  template <class T>
  T whole(std::string_view digits, int base) const {
    T number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
    require(error == std::errc() && end == digits.data() + digits.size(), "no whole number");
    return number;
  }
  static bool is_sum_of_shares(const ShareSums& sums, std::uint64_t n) {
    const double first = sums.first.value(), second = sums.second.value();
    constexpr double kRounding = 1.0 + 1e-12;
    return first >= 0.0 && second >= 0.0 && second <= kRounding * first && first <= kRounding * static_cast<double>(n);
  }

  std::string_view rest_, line_;
  std::uint64_t line_number_ = 0;
};

}  // namespace vex

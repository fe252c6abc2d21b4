// A sum that does not depend on the order in which its numbers are added.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/numeric/expect.h"
#include "engine/numeric/lane.h"

namespace vex {

/// A whole number of units of 2^-448 in 576 bits, of either sign. Each number is cut to that unit once, towards zero,
/// when it is added, and all else is exact: sums are the same for any number of threads. Numbers below 2^-396 lose
/// digits, less than `kUnit` each. Room for sums below 2^127: of the largest numbers, for 2^79 of them, which no run
/// has.
class FixedPointSum {
 public:
  /// The least word first; a negative sum as 2^576 less.
  using Words = std::array<std::uint64_t, 9>;

  static constexpr double kUnit = 0x1p-448;
  /// Of the size of a number.
  static constexpr double kLargest = 0x1p48;

  /// |x| <= kLargest
  void add(double x) {
    VEX_EXPECT(x >= -kLargest && x <= kLargest);
    // |x| = mantissa 2^(exponent - 1075), and a subnormal adds nothing
    const std::uint64_t bits = bits_of(x);
    const auto biased_exponent = static_cast<int>(bits >> 52 & 0x7ffu);
    const int shift = biased_exponent - 1075 + 448;  // of the mantissa's last bit; 396 for 1
    if (shift <= -53) return;
    const std::uint64_t mantissa = (bits & 0x000fffffffffffffu) | 0x0010000000000000u;
    const bool is_negative = bits >> 63 != 0;
    const auto add_or_take = [&](std::size_t k, std::uint64_t word) {
      is_negative ? take_word(k, word) : add_word(k, word);
    };
    if (shift <= 0) {
      add_or_take(0, mantissa >> -shift);
    } else {
      const auto word = static_cast<std::size_t>(shift / 64);
      const int offset = shift % 64;
      add_or_take(word, mantissa << offset);
      if (offset > 11) add_or_take(word + 1, mantissa >> (64 - offset));
    }
  }

  /// Each of them: as one after the other, in a fraction of the time.
  void add(std::span<const double> numbers) {
    // Mantissas of numbers from 2^-64 to below 2 add up in a window of 128 bits from bit kWindow on: 117 bits each at
    // the most.
    constexpr int kWindow = 448 + 1 - 64 - 53, kHighest = 64;
    constexpr std::size_t kMost = 1024;
    while (!numbers.empty()) {
      const std::size_t n = numbers.size() < kMost ? numbers.size() : kMost;
      Word128 window = 0;
      for (const double x : numbers.first(n)) {
        const std::uint64_t bits = bits_of(x);
        const int place = static_cast<int>(bits >> 52) - 1075 + 448 - kWindow;  // with the sign: far above the window
        if (place < 0 || place > kHighest) [[unlikely]] {
          add(x);
          continue;
        }
        window += static_cast<Word128>((bits & 0x000fffffffffffffu) | 0x0010000000000000u) << place;
      }
      const auto low = static_cast<std::uint64_t>(window), high = static_cast<std::uint64_t>(window >> 64);
      constexpr int kOffset = kWindow % 64;
      static_assert(kWindow / 64 == 5 && kOffset > 0);
      add_word(5, low << kOffset);
      add_word(6, high << kOffset | low >> (64 - kOffset));
      add_word(7, high >> (64 - kOffset));
      numbers = numbers.subspan(n);
    }
  }

  FixedPointSum& operator+=(const FixedPointSum& other) {
    for (std::size_t k = 0; k < words_.size(); ++k) add_word(k, other.words_[k]);
    return *this;
  }

  /// Within 2 u, relative.
  double value() const {
    double size = 0.0;
    for (const std::uint64_t word : size_in_units()) size = static_cast<double>(word) + 0x1p-64 * size;
    size *= 0x1p64;
    return is_negative() ? -size : size;
  }

  /// All of it: a sign, and a size in units.
  bool is_negative() const { return words_.back() >> 63 != 0; }
  Words size_in_units() const { return is_negative() ? opposite(words_) : words_; }
  /// The size is below 2^127, so its last bit is 0.
  FixedPointSum(bool is_negative, const Words& size_in_units)
      : words_(is_negative ? opposite(size_in_units) : size_in_units) {
    VEX_EXPECT(size_in_units.back() >> 63 == 0);
  }
  FixedPointSum() = default;

  friend bool operator==(const FixedPointSum&, const FixedPointSum&) = default;

 private:
  __extension__ typedef unsigned __int128 Word128;

  static Words opposite(Words words) {
    bool has_carry = true;
    for (std::uint64_t& word : words) {
      word = ~word + (has_carry ? 1u : 0u);
      has_carry = has_carry && word == 0;
    }
    return words;
  }

  void add_word(std::size_t k, std::uint64_t word) {
    words_[k] += word;
    if (words_[k] >= word) return;  // nothing to carry
    while (++k < words_.size() && ++words_[k] == 0) {
    }
  }

  void take_word(std::size_t k, std::uint64_t word) {
    const std::uint64_t before = words_[k];
    words_[k] = before - word;
    if (before >= word) return;  // nothing to borrow
    while (++k < words_.size() && words_[k]-- == 0) {
    }
  }

  Words words_{};
};

}  // namespace vex

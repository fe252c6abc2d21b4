// What a number is proven to be between.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vex {

template <class L>
struct Interval {
  L lower, upper;

  L width() const { return upper - lower; }
  L middle() const { return L(0.5) * (upper + lower); }
  L half_width() const { return L(0.5) * width(); }
};

/// The next double: what a bound that was rounded to nearest does not exceed.
/// Doubles of one sign stand in the order of their bits, so that no library is called for it.
inline double next_below(double x) {
  if (!(x > -HUGE_VAL)) return x;
  if (x == 0.0) return -std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits < 0 ? bits + 1 : bits - 1);
}
inline double next_above(double x) { return -next_below(-x); }

}  // namespace vex

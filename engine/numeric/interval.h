// What a number is proven to be between.
#pragma once

#include <cmath>

namespace vex {

template <class L>
struct Interval {
  L lower, upper;

  L width() const { return upper - lower; }
  L middle() const { return L(0.5) * (upper + lower); }
  L half_width() const { return L(0.5) * width(); }
};

/// The next double: what a bound that was rounded to nearest does not exceed.
inline double next_below(double x) { return std::nextafter(x, -HUGE_VAL); }
inline double next_above(double x) { return std::nextafter(x, HUGE_VAL); }

}  // namespace vex

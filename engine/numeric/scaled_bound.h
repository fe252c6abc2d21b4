// Bounds times a power of two, which stay bounds.
#pragma once

#include <cmath>
#include <limits>

namespace vex {

/// bound * 2^exponent of a bound of 0 or more, not above it, or not below it: where the result is subnormal or too
/// large it is rounded that way.
inline double scaled_down(double bound, int exponent) {
  const double scaled = std::ldexp(bound, exponent);
  if (std::isinf(scaled)) return std::numeric_limits<double>::max();
  return bound > 0.0 && scaled < std::numeric_limits<double>::min() ? std::nextafter(scaled, 0.0) : scaled;
}
inline double scaled_up(double bound, int exponent) {
  const double scaled = std::ldexp(bound, exponent);
  return bound > 0.0 && scaled < std::numeric_limits<double>::min() ? std::nextafter(scaled, 1.0) : scaled;
}

}  // namespace vex

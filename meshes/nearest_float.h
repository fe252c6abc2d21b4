// Rounding to 32-bit floats, past a fault of compilers.
#pragma once

namespace vex {

/// The 32-bit float nearest to `x`, in double. By way of memory that the compiler may not look through: GCC 12 at -O2
/// takes two conversions to float and back side by side, as those of a point's coordinates are, for none at all.
inline double nearest_float(double x) {
  const volatile float nearest = static_cast<float>(x);
  return double{nearest};
}

}  // namespace vex

// The unit roundoff and Higham's gamma, in which every rounding bound of the engine is counted.
#pragma once

namespace vex {

/// u: one operation rounded to nearest is off by at most u relative to its result (no underflow, no overflow).
inline constexpr double kUnitRoundoff = 0x1p-53;

/// gamma(n) = n u / (1 - n u): the relative error of n successive roundings (Higham, Accuracy and Stability,
/// section 3.1).
constexpr double gamma(int n) { return n * kUnitRoundoff / (1.0 - n * kUnitRoundoff); }

}  // namespace vex

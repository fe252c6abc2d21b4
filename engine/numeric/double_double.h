// Double-double arithmetic: the unevaluated sum of two doubles, about 106 bits (Dekker 1971; Joldes, Muller, Popescu,
// "Tight and rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44, 2017).
//
// For sums and determinants whose double rounding would show in the twelfth digit, and a lane type of one lane: what is
// written over lanes runs in twice the precision with it. Not for the sampler's inner loop.
// No fused operation: products split by Veltkamp's constant, so magnitudes must stay below 2^995; below 2^-960 the
// lower half is lost.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}  // NOLINT(google-explicit-constructor): a double is one
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

  constexpr double value() const { return high + low; }
};

/// a + b exactly, for any a and b (Knuth).
[[gnu::always_inline]] constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// a + b exactly, for |a| >= |b| (Dekker).
[[gnu::always_inline]] constexpr DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly (Dekker's product with Veltkamp's splitting).
[[gnu::always_inline]] constexpr DoubleDouble two_product(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double a_big = kSplitter * a;
  const double a_high = a_big - (a_big - a);
  const double a_low = a - a_high;
  const double b_big = kSplitter * b;
  const double b_high = b_big - (b_big - b);
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

[[gnu::always_inline]] constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }

/// Relative error at most 3 u^2 + 13 u^3 (AccurateDWPlusDW).
[[gnu::always_inline]] constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.high, b.high);
  const DoubleDouble t = two_sum(a.low, b.low);
  const DoubleDouble v = fast_two_sum(s.high, s.low + t.high);
  return fast_two_sum(v.high, t.low + v.low);
}
[[gnu::always_inline]] constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + (-b);
}

/// Relative error at most 7 u^2 (DWTimesDW1).
[[gnu::always_inline]] constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a.high, b.high);
  return fast_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/// Relative error at most 15 u^2 + 56 u^3 (DWDivDW2).
constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double quotient = a.high / b.high;
  // b * quotient, relative error at most 3 u^2 (DWTimesFP1)
  const DoubleDouble p = two_product(b.high, quotient);
  const DoubleDouble s = fast_two_sum(p.high, b.low * quotient);
  const DoubleDouble r = fast_two_sum(s.high, s.low + p.low);
  const double remainder = (a.high - r.high) + (a.low - r.low);
  return fast_two_sum(quotient, remainder / b.high);
}
constexpr DoubleDouble& operator+=(DoubleDouble& a, const DoubleDouble& b) { return a = a + b; }

// Of normalised numbers, as every operation above gives them, the high parts decide unless they are equal.
constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}
constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
constexpr bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
  return a < b || (a.high == b.high && a.low == b.low);
}
constexpr bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
constexpr bool operator==(const DoubleDouble& a, const DoubleDouble& b) { return a.high == b.high && a.low == b.low; }

// --- as a lane type
template <>
struct LaneTraits<DoubleDouble> {
  using Mask = bool;
  using Bits = std::uint64_t;
  static constexpr int width = 1;
  /// Every operation above and the root below is within this of its result: 16 u^2.
  static constexpr double unit_roundoff = 0x1p-102;
};

inline DoubleDouble select(bool condition, const DoubleDouble& if_true, const DoubleDouble& if_false) {
  return condition ? if_true : if_false;
}
inline DoubleDouble blend(bool condition, const DoubleDouble& if_true, const DoubleDouble& if_false) {
  return {blend(condition, if_true.high, if_false.high), blend(condition, if_true.low, if_false.low)};
}
inline DoubleDouble absolute(const DoubleDouble& x) { return x.high < 0.0 ? -x : x; }
inline DoubleDouble larger(const DoubleDouble& a, const DoubleDouble& b) { return a > b ? a : b; }
inline DoubleDouble smaller(const DoubleDouble& a, const DoubleDouble& b) { return a < b ? a : b; }

/// Relative error at most 25/8 u^2 (SQRTDWtoDW: Lefevre, Louvet, Muller, Picot, Rideau, ACM TOMS 49, 2023), and u^2 for
/// the square that is rounded here, not fused.
inline DoubleDouble square_root(const DoubleDouble& x) {
  if (!(x.high > 0.0)) return 0.0;
  const double root = std::sqrt(x.high);
  const DoubleDouble square = two_product(root, root);
  const double remainder = (x.high - square.high) - square.low;  // both exact: root * root is within an ulp or two of x
  return fast_two_sum(root, (remainder + x.low) / (2.0 * root));
}

/// As for doubles: a power of two, by the high parts.
inline Vec3<DoubleDouble> scaled_to_unit_exponent(const Vec3<DoubleDouble>& a) {
  const double largest = larger(std::fabs(a.x.high), larger(std::fabs(a.y.high), std::fabs(a.z.high)));
  const double scale = from_bits((std::uint64_t{2046} - (bits_of(largest) >> 52)) << 52);
  const auto times = [scale](const DoubleDouble& x) { return DoubleDouble{scale * x.high, scale * x.low}; };
  return {times(a.x), times(a.y), times(a.z)};
}

}  // namespace vex

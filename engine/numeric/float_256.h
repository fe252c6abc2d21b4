// Numbers of 256 bits, as a lane type of one lane: for what is written over lanes where twice the precision of a double
// is not enough. Slow: some hundred nanoseconds an operation.
#pragma once

// gcc 12 takes the limbs behind a number's length for uninitialised ones that are read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_bin_float.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include "engine/numeric/vec3.h"
#include "engine/numeric/whole.h"

namespace vex {

struct Float256 {
  using Number =
      boost::multiprecision::number<boost::multiprecision::cpp_bin_float<256, boost::multiprecision::digit_base_2>,
                                    boost::multiprecision::et_off>;
  Number value = 0;

  Float256() = default;
  Float256(double x) : value(x) {}  // NOLINT(google-explicit-constructor): a double is one
  explicit Float256(Number x) : value(std::move(x)) {}
  /// value / 2^exponent, rounded.
  Float256(const whole::Dyadic& x, int exponent) : value(ldexp(Number(x.mantissa), x.exponent - exponent)) {}

  double high() const { return value.convert_to<double>(); }
};

inline Float256 operator-(const Float256& a) { return Float256(Float256::Number(-a.value)); }
inline Float256 operator+(const Float256& a, const Float256& b) {
  return Float256(Float256::Number(a.value + b.value));
}
inline Float256 operator-(const Float256& a, const Float256& b) {
  return Float256(Float256::Number(a.value - b.value));
}
inline Float256 operator*(const Float256& a, const Float256& b) {
  return Float256(Float256::Number(a.value * b.value));
}
inline Float256 operator/(const Float256& a, const Float256& b) {
  return Float256(Float256::Number(a.value / b.value));
}
inline Float256& operator+=(Float256& a, const Float256& b) { return a = a + b; }
inline bool operator<(const Float256& a, const Float256& b) { return a.value < b.value; }
inline bool operator>(const Float256& a, const Float256& b) { return a.value > b.value; }
inline bool operator<=(const Float256& a, const Float256& b) { return a.value <= b.value; }
inline bool operator>=(const Float256& a, const Float256& b) { return a.value >= b.value; }

template <>
struct LaneTraits<Float256> {
  using Mask = bool;
  using Bits = std::uint64_t;
  static constexpr int width = 1;
  static constexpr double unit_roundoff = 0x1p-256;
};

inline Float256 select(bool condition, const Float256& if_true, const Float256& if_false) {
  return condition ? if_true : if_false;
}
/// By a jump: it costs little beside an operation of this many digits.
inline Float256 blend(bool condition, const Float256& if_true, const Float256& if_false) {
  return select(condition, if_true, if_false);
}
inline Float256 absolute(const Float256& x) { return Float256(Float256::Number(abs(x.value))); }
inline Float256 larger(const Float256& a, const Float256& b) { return a > b ? a : b; }
inline Float256 smaller(const Float256& a, const Float256& b) { return a < b ? a : b; }
inline Float256 square_root(const Float256& x) {
  return x.value > 0 ? Float256(Float256::Number(sqrt(x.value))) : Float256();
}

/// As for doubles: a power of two. Zero stays zero.
inline Vec3<Float256> scaled_to_unit_exponent(const Vec3<Float256>& a) {
  const Float256 largest = larger(absolute(a.x), larger(absolute(a.y), absolute(a.z)));
  if (!(largest > Float256())) return a;
  const auto exponent = ilogb(largest.value);
  const auto times = [exponent](const Float256& x) { return Float256(Float256::Number(ldexp(x.value, -exponent))); };
  return {times(a.x), times(a.y), times(a.z)};
}

/// As the sum of two doubles, whatever is left of each coordinate.
inline void split(const Vec3<Float256>& a, Vec3d& high, Vec3d& low) {
  high = {a.x.high(), a.y.high(), a.z.high()};
  const Vec3<Float256> rest = a - broadcast<Float256>(high);
  low = {rest.x.high(), rest.y.high(), rest.z.high()};
}

}  // namespace vex

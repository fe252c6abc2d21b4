// Exact arithmetic on what doubles, their sums and their products are: whole numbers times powers of two.
//
// No common denominators are looked for, so this is many times faster than rational numbers; there is no division.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

#include "engine/numeric/double_double.h"
#include "engine/numeric/vec3.h"

namespace vex::exact {

/// mantissa * 2^exponent.
class Dyadic {
 public:
  Dyadic() = default;
  Dyadic(double value);               // NOLINT(google-explicit-constructor): every finite double is one
  Dyadic(const DoubleDouble& value);  // NOLINT(google-explicit-constructor)

  int sign() const { return mantissa_.sign(); }
  boost::multiprecision::cpp_rational rational() const;

  friend Dyadic operator+(const Dyadic& x, const Dyadic& y);
  friend Dyadic operator-(const Dyadic& x) { return {-x.mantissa_, x.exponent_}; }
  friend Dyadic operator-(const Dyadic& x, const Dyadic& y) { return x + (-y); }
  friend Dyadic operator*(const Dyadic& x, const Dyadic& y) {
    return {x.mantissa_ * y.mantissa_, x.exponent_ + y.exponent_};
  }
  friend bool operator<(const Dyadic& x, const Dyadic& y) { return (x - y).sign() < 0; }

  /// Not below the square root of x >= 0, and above it by no more than one part in 2^255.
  friend Dyadic square_root_from_above(const Dyadic& x);

 private:
  using Whole = boost::multiprecision::cpp_int;
  Dyadic(Whole mantissa, long exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}

  Whole mantissa_ = 0;
  long exponent_ = 0;
};

using DyadicPoint = std::array<Dyadic, 3>;

inline DyadicPoint dyadic(const Vec3d& p) { return {Dyadic(p.x), Dyadic(p.y), Dyadic(p.z)}; }
inline DyadicPoint dyadic(const Vec3<DoubleDouble>& p) { return {Dyadic(p.x), Dyadic(p.y), Dyadic(p.z)}; }
inline DyadicPoint operator+(const DyadicPoint& a, const DyadicPoint& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline DyadicPoint operator-(const DyadicPoint& a, const DyadicPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline DyadicPoint operator*(const Dyadic& s, const DyadicPoint& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Dyadic inner(const DyadicPoint& a, const DyadicPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Dyadic determinant(const DyadicPoint& a, const DyadicPoint& b, const DyadicPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

}  // namespace vex::exact

#include "apps/referees/dyadic.h"

#include <cmath>

#include "engine/numeric/expect.h"

namespace vex::exact {

Dyadic::Dyadic(double value) {
  VEX_EXPECT(std::isfinite(value));
  if (value == 0.0) return;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  auto whole = static_cast<long long>(std::ldexp(fraction, 53));
  exponent_ = exponent - 53;
  // Few bits stay few: cubes and unit vectors have short coordinates.
  const int zeros = __builtin_ctzll(static_cast<unsigned long long>(whole));
  whole >>= zeros;
  exponent_ += zeros;
  mantissa_ = whole;
}

Dyadic::Dyadic(const DoubleDouble& value) { *this = Dyadic(value.high) + Dyadic(value.low); }

boost::multiprecision::cpp_rational Dyadic::rational() const {
  if (exponent_ >= 0) return mantissa_ << exponent_;
  return boost::multiprecision::cpp_rational(mantissa_, Whole(1) << -exponent_);
}

Dyadic operator+(const Dyadic& x, const Dyadic& y) {
  if (x.sign() == 0) return y;
  if (y.sign() == 0) return x;
  if (x.exponent_ < y.exponent_) return {x.mantissa_ + (y.mantissa_ << (y.exponent_ - x.exponent_)), x.exponent_};
  return {(x.mantissa_ << (x.exponent_ - y.exponent_)) + y.mantissa_, y.exponent_};
}

Dyadic square_root_from_above(const Dyadic& x) {
  VEX_EXPECT(x.sign() >= 0);
  if (x.sign() == 0) return {};
  // The whole part of the root of a number of 512 bits or more has 256.
  const long have = static_cast<long>(msb(x.mantissa_));
  long shift = have < 512 ? 512 - have : 0;
  if ((x.exponent_ - shift) % 2 != 0) ++shift;
  const Dyadic::Whole widened = x.mantissa_ << shift;
  Dyadic::Whole rest;
  Dyadic::Whole root = sqrt(widened, rest);
  if (rest != 0) ++root;
  return {root, (x.exponent_ - shift) / 2};
}

}  // namespace vex::exact

#include "engine/numeric/whole.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/numeric/expect.h"

namespace vex::whole {
namespace {

constexpr int kNoBit = std::numeric_limits<int>::max() / 4;

struct Parts {
  std::int64_t mantissa = 0;  // odd, or 0
  int exponent = 0;
};

Parts parts_of(double value) {
  VEX_EXPECT(std::isfinite(value));
  if (value == 0.0) return {};
  const std::uint64_t bits = bits_of(value);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  std::uint64_t digits = bits & ((std::uint64_t{1} << 52) - 1);
  if (biased != 0) digits |= std::uint64_t{1} << 52;
  const int zeros = std::countr_zero(digits);
  const auto mantissa = static_cast<std::int64_t>(digits >> zeros);
  return {value < 0.0 ? -mantissa : mantissa, std::max(biased, 1) - 1075 + zeros};
}

Integer shifted_left(const Integer& value, int bits) {
  VEX_EXPECT(bits >= 0);
  return bits == 0 ? value : Integer(value << static_cast<unsigned>(bits));
}

// The leading 64 bits of |value|, and the exponent that they stand at.
double leading(const Integer& value, int& exponent) {
  if (value == 0) return 0.0;
  const Integer magnitude = abs(value);
  const int length = static_cast<int>(msb(magnitude)) + 1;
  const int drop = std::max(0, length - 64);
  const auto bits = static_cast<std::uint64_t>(Integer(magnitude >> static_cast<unsigned>(drop)));
  exponent = drop;
  return value.sign() < 0 ? -static_cast<double>(bits) : static_cast<double>(bits);
}

}  // namespace

Dyadic::Dyadic(double value) {
  const Parts parts = parts_of(value);
  mantissa = parts.mantissa;
  exponent = parts.exponent;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (sign(a) == 0) return b;
  if (sign(b) == 0) return a;
  const int exponent = std::min(a.exponent, b.exponent);
  return {shifted_left(a.mantissa, a.exponent - exponent) + shifted_left(b.mantissa, b.exponent - exponent), exponent};
}
Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + (-b); }
Dyadic operator*(const Dyadic& a, const Dyadic& b) { return {a.mantissa * b.mantissa, a.exponent + b.exponent}; }

DyadicVector placed(const Transformd& a_from_b, const DyadicVector& point) {
  return DyadicVector{dot(exactly(a_from_b.row_x), point), dot(exactly(a_from_b.row_y), point),
                      dot(exactly(a_from_b.row_z), point)} +
         exactly(a_from_b.translation);
}

DyadicVector direction_to_b(const Transformd& a_from_b, const DyadicVector& dir) {
  const Vec3d &x = a_from_b.row_x, &y = a_from_b.row_y, &z = a_from_b.row_z;
  return {dot(exactly(Vec3d{x.x, y.x, z.x}), dir), dot(exactly(Vec3d{x.y, y.y, z.y}), dir),
          dot(exactly(Vec3d{x.z, y.z, z.z}), dir)};
}

int lowest_exponent(double value) { return value == 0.0 ? kNoBit : parts_of(value).exponent; }
int lowest_exponent(const Dyadic& value) {
  return sign(value) == 0 ? kNoBit : value.exponent + static_cast<int>(lsb(Integer(abs(value.mantissa))));
}

Integer in_units(double value, int exponent) {
  const Parts parts = parts_of(value);
  return parts.mantissa == 0 ? Integer(0) : shifted_left(Integer(parts.mantissa), parts.exponent - exponent);
}
Integer in_units(const Dyadic& value, int exponent) {
  if (value.exponent >= exponent || sign(value) == 0) {
    return sign(value) == 0 ? Integer(0) : shifted_left(value.mantissa, value.exponent - exponent);
  }
  const Integer magnitude = abs(value.mantissa) >> static_cast<unsigned>(exponent - value.exponent);
  return sign(value) < 0 ? Integer(-magnitude) : magnitude;
}

Vec3d rounded_direction(const Vector& a) {
  int e_x = 0, e_y = 0, e_z = 0;
  const Vec3d lead{leading(a.x, e_x), leading(a.y, e_y), leading(a.z, e_z)};
  int top = std::numeric_limits<int>::min();
  const auto raise = [&top](double value, int exponent) {
    if (value != 0.0) top = std::max(top, std::ilogb(value) + 1 + exponent);
  };
  raise(lead.x, e_x);
  raise(lead.y, e_y);
  raise(lead.z, e_z);
  if (top == std::numeric_limits<int>::min()) return {};
  return {std::ldexp(lead.x, e_x - top), std::ldexp(lead.y, e_y - top), std::ldexp(lead.z, e_z - top)};
}

int exponent_of(const Dyadic& value) {
  return sign(value) == 0 ? -kNoBit : static_cast<int>(msb(Integer(abs(value.mantissa)))) + 1 + value.exponent;
}

DoubleDouble rounded(const Dyadic& value, int exponent) {
  // The leading 64 bits of the number, rounded, and those of what that leaves.
  int e_high = 0, e_low = 0;
  const double high = leading(value.mantissa, e_high);
  const double low = leading(value.mantissa - shifted_left(Integer(high), e_high), e_low);
  return fast_two_sum(std::ldexp(high, e_high + value.exponent - exponent),
                      std::ldexp(low, e_low + value.exponent - exponent));
}

Integer floor_of_root(const Integer& value) {
  VEX_EXPECT(value.sign() >= 0);
  return sqrt(value);
}

}  // namespace vex::whole

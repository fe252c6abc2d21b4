// Whole numbers of any size, and doubles as such: the arithmetic of exact verdicts.
//
// A double is a whole number times a power of two, and so is every sum and product of doubles. Two forms: `Dyadic`, a
// number with an exponent of its own; and vectors of plain whole numbers, for which all coordinates of a scene are
// brought to one exponent, after which nothing needs scaling any more.
#pragma once

#include <algorithm>

// gcc 12 takes the limbs behind a number's length for uninitialised ones that are read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include "engine/numeric/double_double.h"
#include "engine/numeric/transform.h"
#include "engine/numeric/vec3.h"

namespace vex::whole {

/// Up to 512 bits live without an allocation.
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;

inline int sign(const Integer& x) { return x.sign(); }

struct Vector {
  Integer x, y, z;
};
inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
inline Vector operator*(const Integer& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Integer dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline bool is_zero(const Vector& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/// mantissa * 2^exponent, exactly.
struct Dyadic {
  Integer mantissa = 0;
  int exponent = 0;

  Dyadic() = default;
  Dyadic(double value);  // NOLINT(google-explicit-constructor): a finite double is one
  Dyadic(Integer m, int e) : mantissa(std::move(m)), exponent(e) {}
};
Dyadic operator+(const Dyadic& a, const Dyadic& b);
Dyadic operator-(const Dyadic& a, const Dyadic& b);
Dyadic operator*(const Dyadic& a, const Dyadic& b);
inline Dyadic operator-(const Dyadic& a) { return {Integer(-a.mantissa), a.exponent}; }
inline int sign(const Dyadic& a) { return a.mantissa.sign(); }
inline bool operator<(const Dyadic& a, const Dyadic& b) { return sign(a - b) < 0; }

struct DyadicVector {
  Dyadic x, y, z;
};
inline DyadicVector exactly(const Vec3d& a) { return {a.x, a.y, a.z}; }
inline DyadicVector operator+(const DyadicVector& a, const DyadicVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline DyadicVector operator-(const DyadicVector& a, const DyadicVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline DyadicVector operator-(const DyadicVector& a) { return {-a.x, -a.y, -a.z}; }
inline Dyadic dot(const DyadicVector& a, const DyadicVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// R p + t and R^T d, without rounding.
DyadicVector placed(const Transformd& a_from_b, const DyadicVector& point);
DyadicVector direction_to_b(const Transformd& a_from_b, const DyadicVector& dir);

/// The exponent of the lowest bit that is set; a large number for 0, which has none.
int lowest_exponent(double value);
int lowest_exponent(const Dyadic& value);
/// The lowest one of `exponent` and of those of the coordinates. Of most vertices of a body none is below those before.
inline int lowest_exponent(int exponent, const Vec3d& v) {
  for (const double value : {v.x, v.y, v.z}) {
    const int biased = static_cast<int>((bits_of(value) >> 52) & 0x7ff);
    // A double has no bit below the one that its own exponent leaves.
    if (std::max(biased, 1) - 1075 < exponent) exponent = std::min(exponent, lowest_exponent(value));
  }
  return exponent;
}
/// value / 2^exponent, which must be whole.
Integer in_units(double value, int exponent);
Integer in_units(const Dyadic& value, int exponent);
inline Vector in_units(const Vec3d& a, int exponent) {
  return {in_units(a.x, exponent), in_units(a.y, exponent), in_units(a.z, exponent)};
}
inline Vector in_units(const DyadicVector& a, int exponent) {
  return {in_units(a.x, exponent), in_units(a.y, exponent), in_units(a.z, exponent)};
}

/// A vector of the same direction to 2^-52 of each coordinate, its largest coordinate in [1/2, 1); zero stays zero.
Vec3d rounded_direction(const Vector& a);

/// One more than the exponent of the highest bit; a very small number for 0.
int exponent_of(const Dyadic& value);
/// value / 2^exponent to within 2^-105 of itself, if that does not overflow.
DoubleDouble rounded(const Dyadic& value, int exponent);

/// floor(sqrt(value)) for value >= 0.
Integer floor_of_root(const Integer& value);

}  // namespace vex::whole

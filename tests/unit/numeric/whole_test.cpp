#include "engine/numeric/whole.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "apps/referees/exact_overlap.h"
#include "tests/referees/random_poses.h"

namespace vex::whole {
namespace {

using boost::multiprecision::cpp_int;
using vex::exact::Rational;

Rational exactly_of(const Integer& value, int exponent) {
  const cpp_int mantissa(value);
  const cpp_int power = cpp_int(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent >= 0 ? Rational(mantissa * power) : Rational(mantissa, power);
}
Rational exactly_of(const Dyadic& x) { return exactly_of(x.mantissa, x.exponent); }

// Doubles of every kind: anything finite, denormal, huge, round, zero.
double any_double(std::mt19937_64& random) {
  switch (random() % 8) {
    case 0: return 0.0;
    case 1: return -0.0;
    case 2: return std::ldexp(static_cast<double>(random() % 1024), -1074);  // denormal
    case 3: return 1e300 * (random_in_unit_interval(random) - 0.5);
    case 4: return static_cast<double>(random() % 17) - 8.0;
    default: break;
  }
  const double value = std::ldexp(1.0 + random_in_unit_interval(random), static_cast<int>(random() % 2040) - 1020);
  return (random() & 1) != 0 ? value : -value;
}
Vec3d any_vector(std::mt19937_64& random) { return {any_double(random), any_double(random), any_double(random)}; }
Transformd any_transform(std::mt19937_64& random) {
  return {any_vector(random), any_vector(random), any_vector(random), any_vector(random)};
}

TEST(Whole, ADyadicIsItsDouble) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 2000; ++k) {
    const double x = any_double(random);
    ASSERT_EQ(exactly_of(Dyadic(x)), Rational(x)) << x;
  }
  EXPECT_EQ(exactly_of(Dyadic(0x1p-1074)), Rational(0x1p-1074));
  EXPECT_EQ(exactly_of(Dyadic(0x1.fffffffffffffp1023)), Rational(0x1.fffffffffffffp1023));
}

TEST(Whole, DyadicArithmeticIsExact) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 2000; ++k) {
    const double x = any_double(random), y = any_double(random), z = any_double(random);
    const Dyadic a(x), b(y), c(z);
    const Rational p(x), q(y), r(z);
    ASSERT_EQ(exactly_of(a + b), p + q);
    ASSERT_EQ(exactly_of(a - b), p - q);
    ASSERT_EQ(exactly_of(a * b), p * q);
    ASSERT_EQ(exactly_of(-a), -p);
    ASSERT_EQ(exactly_of(a * b + c * (a - b)), p * q + r * (p - q));
    ASSERT_EQ(a < b, p < q);
    ASSERT_EQ(a * b < c, p * q < r);
    ASSERT_EQ(sign(a - a), 0);
    ASSERT_FALSE(a < a);
  }
}

TEST(Whole, PlacedPointsAndDirectionsAreExact) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 500; ++k) {
    const Transformd pose = k % 2 == 0 ? any_transform(random) : random_rotation(random);
    const Vec3d p = any_vector(random);
    const exact::Point point = exact::exactly(p), t = exact::exactly(pose.translation);
    const exact::Point rows[3] = {exact::exactly(pose.row_x), exact::exactly(pose.row_y), exact::exactly(pose.row_z)};
    const DyadicVector to = placed(pose, exactly(p));
    ASSERT_EQ(exactly_of(to.x), exact::inner(rows[0], point) + t[0]);
    ASSERT_EQ(exactly_of(to.y), exact::inner(rows[1], point) + t[1]);
    ASSERT_EQ(exactly_of(to.z), exact::inner(rows[2], point) + t[2]);
    const DyadicVector back = direction_to_b(pose, exactly(p));
    const Dyadic* const coordinates[3] = {&back.x, &back.y, &back.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational sum = rows[0][i] * point[0] + rows[1][i] * point[1] + rows[2][i] * point[2];
      ASSERT_EQ(exactly_of(*coordinates[i]), sum);
    }
  }
}

TEST(Whole, UnitsAreWhereTheLowestBitIs) {
  EXPECT_EQ(lowest_exponent(1.0), 0);
  EXPECT_EQ(lowest_exponent(-12.0), 2);
  EXPECT_EQ(lowest_exponent(0.375), -3);
  EXPECT_EQ(lowest_exponent(0x1p-1074), -1074);
  EXPECT_EQ(lowest_exponent(0x1p1023), 1023);
  EXPECT_GT(lowest_exponent(0.0), 100000) << "zero has no bit";
  EXPECT_EQ(lowest_exponent(0.0), lowest_exponent(Dyadic()));
  EXPECT_EQ(lowest_exponent(Dyadic(Integer(24), -7)), -4);
  EXPECT_EQ(lowest_exponent(Dyadic(Integer(-24), 7)), 10);
  EXPECT_EQ(lowest_exponent(5, Vec3d{0.0, 1.0, -0.375}), -3);
  EXPECT_EQ(lowest_exponent(-4, Vec3d{0.0, 1.0, -0.375}), -4);
  EXPECT_EQ(lowest_exponent(lowest_exponent(0.0), Vec3d{-0.0, 0x1p-1074, 0x1p1023}), -1074);
  EXPECT_EQ(lowest_exponent(lowest_exponent(0.0), Vec3d{}), lowest_exponent(0.0));
  std::mt19937_64 random(4);
  for (int k = 0; k < 2000; ++k) {
    const double x = any_double(random);
    const Dyadic product = Dyadic(x) * Dyadic(any_double(random));
    if (x != 0.0) {
      const int unit = lowest_exponent(x);
      ASSERT_EQ(Integer(abs(in_units(x, unit)) % 2), 1) << "the lowest bit is set";
      const int finer = unit - static_cast<int>(random() % 500);
      ASSERT_EQ(exactly_of(in_units(x, finer), finer), Rational(x));
    } else {
      ASSERT_EQ(in_units(x, 7), 0);
    }
    if (sign(product) != 0) {
      // Mantissas with zeros at their end, and units on both sides of the stored exponent.
      const Dyadic stored{Integer(product.mantissa << 40u), product.exponent - 40};
      const int unit = lowest_exponent(stored);
      ASSERT_EQ(unit, lowest_exponent(product));
      for (const int finer : {unit, unit - 7, unit - 40, unit - 300}) {
        ASSERT_EQ(exactly_of(in_units(stored, finer), finer), exactly_of(product));
      }
    }
  }
}

// A whole number of up to `bits` bits.
Integer any_integer(std::mt19937_64& random, unsigned bits) {
  Integer value = 0;
  for (unsigned k = 0; k < bits; k += 64) value = (value << 64u) + Integer(random());
  value >>= static_cast<unsigned>(random() % (bits + 1));
  return (random() & 1) != 0 ? value : Integer(-value);
}

TEST(Whole, ARoundedDirectionIsTheDirection) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 3000; ++k) {
    Vector v{any_integer(random, 3000), any_integer(random, 200), any_integer(random, 3000)};
    if (k % 3 == 0) v.y = 0;
    if (k % 7 == 0) v.x = (Integer(1) << 100u) - 1;  // rounds up to the next power of two
    if (is_zero(v)) continue;
    const Vec3d d = rounded_direction(v);
    const double largest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    ASSERT_GE(largest, 0.5);
    ASSERT_LT(largest, 1.0);
    // d * 2^top = v to 2^-52 of each coordinate, where top makes the largest fit best.
    const double at = std::fabs(d.x) == largest ? d.x : (std::fabs(d.y) == largest ? d.y : d.z);
    const Integer& of = std::fabs(d.x) == largest ? v.x : (std::fabs(d.y) == largest ? v.y : v.z);
    int top = static_cast<int>(msb(Integer(abs(of)))) + 1;
    const auto is_near = [&top](double rounded, const Integer& exact) {
      const Rational off = abs(Rational(rounded) * exactly_of(Integer(1), top) - exactly_of(exact, 0));
      return off <= Rational(0x1p-52) * abs(exactly_of(exact, 0)) || off <= exactly_of(Integer(1), top - 1074);
    };
    if (!is_near(at, of)) ++top;
    ASSERT_TRUE(is_near(d.x, v.x) && is_near(d.y, v.y) && is_near(d.z, v.z));
  }
  const Vec3d zero = rounded_direction({0, 0, 0});
  EXPECT_TRUE(zero.x == 0.0 && zero.y == 0.0 && zero.z == 0.0);
}

TEST(Whole, FloorOfRootIsTheFloor) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 1000; ++k) {
    Integer value = abs(any_integer(random, 2000));
    if (k % 3 == 0) value = value * value;              // a square
    if (k % 3 == 1) value = value * value + 2 * value;  // one below the next
    const Integer root = floor_of_root(value);
    ASSERT_LE(root * root, value);
    ASSERT_GT((root + 1) * (root + 1), value);
  }
  EXPECT_EQ(floor_of_root(Integer(0)), 0);
  EXPECT_EQ(floor_of_root(Integer(1)), 1);
}

TEST(Whole, VectorsAreMultipliedExactly) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 300; ++k) {
    const Vector a{any_integer(random, 300), any_integer(random, 300), any_integer(random, 300)};
    const Vector b{any_integer(random, 300), any_integer(random, 300), any_integer(random, 300)};
    const Vector c = cross(a, b);
    ASSERT_EQ(dot(c, a), 0);
    ASSERT_EQ(dot(c, b), 0);
    ASSERT_EQ(dot(c, c), dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b)) << "Lagrange's identity";
    ASSERT_TRUE(is_zero(a - a));
    ASSERT_TRUE(is_zero(-a + a));
    ASSERT_EQ(dot(Integer(3) * a, b), 3 * dot(a, b));
  }
}

}  // namespace
}  // namespace vex::whole

#include "meshes/exact_sign.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace vex::tests {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using RationalVec3 = std::array<Rational, 3>;

RationalVec3 difference(const Vec3d& p, const LocalPoint& o) {
  return {Rational(p.x) - Rational(o.base.x) - Rational(o.step.x),
          Rational(p.y) - Rational(o.base.y) - Rational(o.step.y),
          Rational(p.z) - Rational(o.base.z) - Rational(o.step.z)};
}

int rational_sign(const LocalPoint& o, const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  const RationalVec3 a = difference(p, o), b = difference(q, o), c = difference(r, o);
  const Rational det =
      a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  return det.sign();
}

/// Four points in a plane to rounding, at any size and place, some exactly.
std::array<Vec3d, 4> nearly_coplanar(std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_int_distribution<int> whole(-3, 3);
  const bool is_lattice = whole(*random) > 0;
  const auto number = [&] { return is_lattice ? static_cast<double>(whole(*random)) : unit(*random); };
  const auto vector = [&] { return Vec3d{number(), number(), number()}; };
  const Vec3d far = std::ldexp(1.0, 10 * std::abs(whole(*random))) * vector();
  const double size = std::ldexp(1.0, 20 * whole(*random));
  const Vec3d u = vector(), v = vector();
  std::array<Vec3d, 4> points;
  for (Vec3d& p : points) {
    p = size * (far + (number() * u + number() * v));
  }
  return points;
}

TEST(ExactSign, OfNearlyCoplanarPointsIsTheRationalOne) {
  std::mt19937_64 random(5);
  std::array<int, 3> n_of_sign{};
  for (int i = 0; i < 20000; ++i) {
    const auto [a, b, c, d] = nearly_coplanar(&random);
    const int sign = orientation_sign(a, b, c, d);
    ++n_of_sign[static_cast<std::size_t>(sign + 1)];
    ASSERT_EQ(sign, rational_sign({a, {}}, b, c, d)) << i;
  }
  for (const int n : n_of_sign) {  // each sign was there often
    EXPECT_GT(n, 4000);
  }
}

TEST(ExactSign, AboutAPointWithAStepIsTheRationalOne) {
  std::mt19937_64 random(6);
  std::array<int, 3> n_of_sign{};
  for (int i = 0; i < 20000; ++i) {
    auto [a, b, c, d] = nearly_coplanar(&random);
    const LocalPoint o{a, 0.25 * (d - a)};
    const int sign = determinant_sign(o, b, c, d, o.to(b).value(), o.to(c).value(), o.to(d).value());
    ++n_of_sign[static_cast<std::size_t>(sign + 1)];
    ASSERT_EQ(sign, rational_sign(o, b, c, d)) << i;
  }
  for (const int n : n_of_sign) {
    EXPECT_GT(n, 4000);
  }
}

TEST(ExactSign, HoldsForTheLeastAndTheLargestCoordinates) {
  for (const double size : {0x1p-300, 0x1p-149, 0x1p128, 0x1p300}) {
    const Vec3d a{}, b{size, 0, 0}, c{0, size, 0};
    EXPECT_EQ(orientation_sign(a, b, c, {size, size, size}), 1);
    EXPECT_EQ(orientation_sign(a, b, c, {size, size, -size}), -1);
    EXPECT_EQ(orientation_sign(a, b, c, {size, size, 0}), 0);
  }
}

TEST(ExactSign, KnowsALine) {
  EXPECT_TRUE(collinear({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
  EXPECT_FALSE(collinear({0, 0, 0}, {1, 2, 3}, {3, 6, std::nextafter(9.0, 10.0)}));
  EXPECT_TRUE(collinear({1, 2, 3}, {1, 2, 3}, {4, 5, 7}));
  const double third = 1.0 / 3.0;
  EXPECT_FALSE(collinear({0, 0, 0}, {1, 3, 0}, {third, 1, 0}));  // a third is not a double
}

}  // namespace
}  // namespace vex::tests

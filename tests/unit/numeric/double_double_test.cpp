#include "engine/numeric/double_double.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace vex {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exactly(const DoubleDouble& x) { return Rational(x.high) + Rational(x.low); }

// Magnitudes spread over 2^-40 ... 2^40, both signs.
double wild(std::mt19937_64& random) {
  const double mantissa = 1.0 + static_cast<double>(random() >> 12) * 0x1p-52;
  const double value = std::ldexp(mantissa, static_cast<int>(random() % 81) - 40);
  return (random() & 1) != 0 ? value : -value;
}

TEST(DoubleDouble, SumAndProductOfTwoDoublesAreExact) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 5000; ++k) {
    const double a = wild(random), b = wild(random);
    ASSERT_EQ(exactly(two_sum(a, b)), Rational(a) + Rational(b));
    ASSERT_EQ(exactly(two_product(a, b)), Rational(a) * Rational(b));
  }
}

TEST(DoubleDouble, SumsAndProductsAreWithinTheirBounds) {
  std::mt19937_64 random(2);
  const Rational u_sq = Rational(std::ldexp(1.0, -106));
  for (int k = 0; k < 5000; ++k) {
    const DoubleDouble a = two_sum(wild(random), wild(random) * 0x1p-60);
    const DoubleDouble b = two_sum(wild(random), wild(random) * 0x1p-60);
    const Rational sum = exactly(a) + exactly(b), product = exactly(a) * exactly(b);
    ASSERT_LE(abs(exactly(a + b) - sum), 4 * u_sq * abs(sum));
    ASSERT_LE(abs(exactly(a * b) - product), 8 * u_sq * abs(product));
  }
}

TEST(DoubleDouble, SumKeepsWhatCancels) {
  DoubleDouble sum = 1e17;
  sum += 1.0;
  sum += -1e17;
  EXPECT_EQ(sum.value(), 1.0);
}

// A normalised pair: the lower half as large as it may be, or up to 2^29 times smaller.
DoubleDouble wild_pair(std::mt19937_64& random) {
  const double high = wild(random);
  const double fraction = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
  const int smaller = (random() & 1) != 0 ? 0 : static_cast<int>(random() % 30);
  return fast_two_sum(high, std::ldexp(fraction * high, -54 - smaller));
}

const Rational kUSquared = Rational(0x1p-106);

TEST(DoubleDouble, SumsThatCancelAreWithinTheirBound) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 20000; ++k) {
    const DoubleDouble a = wild_pair(random);
    // -a but for its last bits, or but for a factor near 1
    const double off = std::ldexp(wild(random), -40 - static_cast<int>(random() % 70));
    const DoubleDouble b =
        -(a * DoubleDouble(1.0, 0.5 * std::clamp(off, -0x1p-53, 0x1p-53))) + DoubleDouble(off * a.low);
    const Rational sum = exactly(a) + exactly(b), difference = exactly(a) - exactly(b);
    ASSERT_LE(abs(exactly(a + b) - sum), 4 * kUSquared * abs(sum));
    ASSERT_LE(abs(exactly(a - b) - difference), 4 * kUSquared * abs(difference));
  }
}

TEST(DoubleDouble, QuotientsAreWithinTheirBound) {
  std::mt19937_64 random(4);
  Rational worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const DoubleDouble a = wild_pair(random), b = wild_pair(random);
    const Rational quotient = exactly(a) / exactly(b);
    worst = std::max(worst, Rational(abs(exactly(a / b) / quotient - 1) / kUSquared));
  }
  EXPECT_LE(worst, 16);
  EXPECT_GE(worst, 2) << "the sample must reach what there is to bound";
}

TEST(DoubleDouble, RootsAreWithinTheirBound) {
  std::mt19937_64 random(5);
  Rational worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const DoubleDouble a = absolute(wild_pair(random));
    const Rational root = exactly(square_root(a));
    ASSERT_GT(root, 0);
    // (r (1 + e))^2 = a (1 + 2 e + e^2)
    worst = std::max(worst, Rational(abs(root * root / exactly(a) - 1) / 2 / kUSquared));
  }
  EXPECT_LE(worst, 5);
  EXPECT_GE(worst, 1) << "the sample must reach what there is to bound";
  for (const double square : {0.25, 4.0, 0x1p-900, 0x1p900, 49.0}) {
    EXPECT_EQ(square_root(DoubleDouble(square)), DoubleDouble(std::sqrt(square)));
  }
}

TEST(DoubleDouble, EveryOperationIsWithinTheUnitRoundoffOfTheLaneType) {
  // Chains as a search has them: a root of a sum of squares, a quotient by it, a determinant.
  std::mt19937_64 random(6);
  const Rational u = Rational(unit_roundoff<DoubleDouble>());
  EXPECT_GE(u, 16 * kUSquared);
  for (int k = 0; k < 3000; ++k) {
    const Vec3<DoubleDouble> a{wild_pair(random), wild_pair(random), wild_pair(random)};
    const Rational square = exactly(a.x) * exactly(a.x) + exactly(a.y) * exactly(a.y) + exactly(a.z) * exactly(a.z);
    const Rational length = exactly(norm(a));
    // One rounding of a square, two of sums, halved by the root, and the root's own.
    ASSERT_LE(abs(length * length / square - 1), 2 * (1 + 3) * u);
    const Rational unit_x = exactly(a.x / norm(a));
    ASSERT_LE(abs(unit_x * unit_x * square - exactly(a.x) * exactly(a.x)), 11 * u * exactly(a.x) * exactly(a.x));
  }
}

TEST(DoubleDouble, ComparesAsTheNumbersDo) {
  std::mt19937_64 random(7);
  std::vector<DoubleDouble> all = {0.0, -0.0, 1.0, {1.0, 0x1p-54}, {1.0, -0x1p-54}, {1.0, 0x1p-1074}, -1.0};
  for (int k = 0; k < 40; ++k) all.push_back(wild_pair(random));
  for (const DoubleDouble& a : all) {
    for (const DoubleDouble& b : all) {
      const Rational x = exactly(a), y = exactly(b);
      ASSERT_EQ(a < b, x < y);
      ASSERT_EQ(a > b, x > y);
      ASSERT_EQ(a <= b, x <= y);
      ASSERT_EQ(a >= b, x >= y);
      ASSERT_EQ(a == b, x == y);
      ASSERT_EQ(exactly(larger(a, b)), std::max(x, y));
    }
    ASSERT_EQ(exactly(absolute(a)), abs(exactly(a)));
  }
}

TEST(DoubleDouble, OfZeroAndBelow) {
  EXPECT_EQ(square_root(DoubleDouble(0.0)), DoubleDouble(0.0));
  EXPECT_EQ(square_root(DoubleDouble(-1.0)), DoubleDouble(0.0))
      << "a root of nothing, as norms of zero vectors need it";
  EXPECT_EQ(DoubleDouble(0.0) / DoubleDouble(3.0), DoubleDouble(0.0));
  EXPECT_EQ(DoubleDouble(6.0) / DoubleDouble(-3.0), DoubleDouble(-2.0));
  EXPECT_EQ(DoubleDouble(1.0, 0x1p-60) - DoubleDouble(1.0), DoubleDouble(0x1p-60));
}

TEST(DoubleDouble, IsChosenByBits) {
  for (const double x : {0.0, -0.0, 1.5, -0x1p-1074, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    const double y = 0x1.23456789abcdep-7;
    EXPECT_EQ(bits_of(blend(true, x, y)), bits_of(x));
    EXPECT_EQ(bits_of(blend(false, x, y)), bits_of(y));
    EXPECT_EQ(bits_of(blend(false, y, x)), bits_of(x));
    const DoubleDouble of_x(x, 0x1p-1074), of_y(y, -0.0);
    const DoubleDouble first = blend(true, of_x, of_y), second = blend(false, of_x, of_y);
    EXPECT_EQ(bits_of(first.high), bits_of(x));
    EXPECT_EQ(bits_of(first.low), bits_of(0x1p-1074));
    EXPECT_EQ(bits_of(second.high), bits_of(y));
    EXPECT_EQ(bits_of(second.low), bits_of(-0.0));
  }
  EXPECT_EQ(blend(true, std::uint64_t{7}, ~std::uint64_t{0}), 7u);
}

TEST(DoubleDouble, IsScaledByAPowerOfTwoExactly) {
  std::mt19937_64 random(8);
  for (int k = 0; k < 2000; ++k) {
    const double unit = std::ldexp(1.0, static_cast<int>(random() % 1600) - 800);
    const DoubleDouble x = DoubleDouble(unit) * wild_pair(random), y = DoubleDouble(unit) * wild_pair(random);
    const Vec3<DoubleDouble> v = scaled_to_unit_exponent(Vec3<DoubleDouble>{x, y, 0.0});
    const double largest = std::max(std::fabs(v.x.high), std::fabs(v.y.high));
    ASSERT_GE(largest, 1.0);
    ASSERT_LT(largest, 2.0);
    ASSERT_EQ(exactly(v.x) * exactly(y), exactly(v.y) * exactly(x));
    ASSERT_EQ(v.z, DoubleDouble(0.0));
  }
  const Vec3<DoubleDouble> zero = scaled_to_unit_exponent(Vec3<DoubleDouble>{});
  EXPECT_EQ(zero.x, DoubleDouble(0.0));
  const Vec3<DoubleDouble> least = scaled_to_unit_exponent(Vec3<DoubleDouble>{0x1p-1074, 0.0, -0x1p-1070});
  EXPECT_EQ(least.z.high, -16.0 * least.x.high);
}

}  // namespace
}  // namespace vex

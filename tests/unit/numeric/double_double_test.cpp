#include "engine/numeric/double_double.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

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

}  // namespace
}  // namespace vex

// Whole numbers times powers of two: exact, from the smallest double to the largest.
#include "apps/referees/dyadic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace vex::exact {
namespace {

using boost::multiprecision::cpp_rational;

TEST(Dyadic, HoldsEveryDouble) {
  for (const double x : {0.0, 1.0, -1.0, 0.1, 3e-320, -std::numeric_limits<double>::max(), 4096.0}) {
    EXPECT_EQ(Dyadic(x).rational(), cpp_rational(x)) << x;
  }
  EXPECT_EQ(Dyadic(DoubleDouble(1.0, 0x1p-80)).rational(), cpp_rational(1.0) + cpp_rational(0x1p-80));
}

TEST(Dyadic, SumsAndProductsAreThoseOfRationalNumbers) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    const double x = uniform(random) * std::ldexp(1.0, static_cast<int>(random() % 600) - 300);
    const double y = uniform(random) * std::ldexp(1.0, static_cast<int>(random() % 600) - 300);
    EXPECT_EQ((Dyadic(x) + Dyadic(y)).rational(), cpp_rational(x) + cpp_rational(y));
    EXPECT_EQ((Dyadic(x) - Dyadic(y)).rational(), cpp_rational(x) - cpp_rational(y));
    EXPECT_EQ((Dyadic(x) * Dyadic(y)).rational(), cpp_rational(x) * cpp_rational(y));
    EXPECT_EQ(Dyadic(x) < Dyadic(y), x < y);
  }
}

TEST(Dyadic, TheRootIsNotBelowAndHardlyAbove) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const double x = uniform(random) * std::ldexp(1.0, static_cast<int>(random() % 1200) - 600);
    const cpp_rational root = square_root_from_above(Dyadic(x)).rational();
    EXPECT_GE(root * root, cpp_rational(x));
    const cpp_rational less = root * (1 - cpp_rational(1, boost::multiprecision::cpp_int(1) << 255));
    EXPECT_LT(less * less, cpp_rational(x)) << x;
  }
  EXPECT_EQ(square_root_from_above(Dyadic(0x1p-600)).rational(), cpp_rational(0x1p-300));
  EXPECT_EQ(square_root_from_above(Dyadic(9.0)).rational(), cpp_rational(3));
  EXPECT_EQ(square_root_from_above(Dyadic(0.0)).sign(), 0);
}

}  // namespace
}  // namespace vex::exact

#include "engine/numeric/fixed_point_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

FixedPointSum sum_of(const std::vector<double>& numbers) {
  FixedPointSum sum;
  for (const double x : numbers) sum.add(x);
  return sum;
}

// Each number cut to 2^-448, all else exact.
cpp_rational exact_sum(const std::vector<double>& numbers) {
  const cpp_int unit = cpp_int(1) << 448;
  cpp_int sum = 0;
  for (const double x : numbers) {
    const cpp_rational scaled = cpp_rational(x) * unit;
    sum += numerator(scaled) / denominator(scaled);
  }
  return cpp_rational(sum, unit);
}

double error_in_u(const FixedPointSum& found, const cpp_rational& truth) {
  const cpp_rational difference = abs(cpp_rational(found.value()) - truth);
  return static_cast<double>(cpp_rational(difference / truth)) / kUnitRoundoff;
}

// Between 0 and 1, of exponents down to `lowest`, with a full mantissa.
std::vector<double> numbers_down_to(int lowest, int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> numbers;
  for (int k = 0; k < n; ++k) {
    const double mantissa = 0.5 + static_cast<double>(random() >> 12) * 0x1p-53;
    numbers.push_back(std::ldexp(mantissa, -static_cast<int>(random() % static_cast<std::uint64_t>(-lowest))));
  }
  return numbers;
}

TEST(FixedPointSum, IsTheExactSumToTwoRoundoffs) {
  for (const int lowest : {-1, -10, -70, -390, -470, -1070}) {
    const std::vector<double> numbers = numbers_down_to(lowest, 3000, 1);
    EXPECT_LE(error_in_u(sum_of(numbers), exact_sum(numbers)), 2.001) << lowest;
  }
}

TEST(FixedPointSum, OfManyAtOnceIsTheSumOneByOne) {
  for (const int lowest : {-1, -10, -62, -70, -390, -1070}) {
    for (const int n : {0, 1, 7, 1023, 1024, 1025, 5000}) {
      std::vector<double> numbers = numbers_down_to(lowest, n, 3);
      for (std::size_t k = 0; k < numbers.size(); k += 5) numbers[k] = k % 2 == 0 ? 1.0 : 0.0;
      FixedPointSum at_once = sum_of({0.75, 0x1p-440});
      at_once.add(numbers);
      FixedPointSum one_by_one = sum_of({0.75, 0x1p-440});
      one_by_one += sum_of(numbers);
      EXPECT_EQ(at_once, one_by_one) << n << " numbers down to 2^" << lowest;
    }
  }
  // All of the window's bits, and what it carries.
  std::vector<double> ones(4096, 1.0 - 0x1p-53);
  ones.insert(ones.end(), 4096, 1.0);
  ones.insert(ones.end(), 4096, 0x1p-64);
  FixedPointSum at_once;
  at_once.add(ones);
  EXPECT_EQ(at_once, sum_of(ones));
}

TEST(FixedPointSum, HoldsEveryNumberByItself) {
  for (const double x : numbers_down_to(-395, 3000, 2)) ASSERT_EQ(sum_of({x}).value(), x);
  for (int exponent = 0; exponent >= -448; --exponent) {
    const double x = std::ldexp(1.0, exponent);
    ASSERT_EQ(sum_of({x}).value(), x) << exponent;
  }
  EXPECT_EQ(sum_of({0x1.fffffffffffffp-396}).value(), 0x1.fffffffffffffp-396) << "the last with all its digits";
  EXPECT_EQ(sum_of({0x1.fffffffffffffp-397}).value(), 0x1.ffffffffffffep-397) << "cut, not rounded";
  EXPECT_EQ(sum_of({0x1.fffffffffffffp-448}).value(), FixedPointSum::kUnit);
}

TEST(FixedPointSum, ZeroOfEitherSignAndNumbersBelowTheUnitAddNothing) {
  const FixedPointSum nothing;
  EXPECT_EQ(nothing.value(), 0.0);
  for (const double x : {0.0, -0.0, 0x1.fffffffffffffp-449, 0x1p-500, 0x1p-1022, 0x1p-1074}) {
    EXPECT_EQ(sum_of({x}), nothing) << x;
  }
  // Taken for an exponent, the sign of -0.0 reached past the sum, into what lies behind it.
  std::array<FixedPointSum, 4> row;
  row[0].add(-0.0);
  for (const FixedPointSum& sum : row) EXPECT_EQ(sum, nothing);
}

TEST(FixedPointSum, DoesNotDependOnTheOrder) {
  std::vector<double> numbers = numbers_down_to(-500, 5000, 3);
  numbers.insert(numbers.end(), 100, 1.0);
  const FixedPointSum sum = sum_of(numbers);
  std::mt19937_64 random(4);
  for (int k = 0; k < 5; ++k) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    ASSERT_EQ(sum_of(numbers), sum);
  }
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(sum_of(numbers), sum);
  // Added in parts, as threads do.
  const auto middle = numbers.begin() + 1234;
  FixedPointSum parts = sum_of({middle, numbers.end()});
  parts += sum_of({numbers.begin(), middle});
  EXPECT_EQ(parts, sum);
}

TEST(FixedPointSum, CarriesThroughEveryWord) {
  std::vector<double> numbers;
  for (int k = 1; k <= 448; ++k) numbers.push_back(std::ldexp(1.0, -k));
  FixedPointSum sum = sum_of(numbers);  // 1 - 2^-448: every bit below 1 is set
  EXPECT_EQ(sum.value(), 1.0) << "to rounding";
  EXPECT_NE(sum, sum_of({1.0}));
  sum.add(FixedPointSum::kUnit);
  EXPECT_EQ(sum, sum_of({1.0}));
  FixedPointSum by_parts = sum_of(numbers);
  by_parts += sum_of({FixedPointSum::kUnit});
  EXPECT_EQ(by_parts, sum_of({1.0}));
}

TEST(FixedPointSum, HasRoomForMoreNumbersThanARunHas) {
  FixedPointSum sum = sum_of({1.0});
  FixedPointSum with_a_trifle = sum_of({1.0, FixedPointSum::kUnit});
  for (int k = 0; k < 62; ++k) {
    sum += FixedPointSum(sum);
    with_a_trifle += FixedPointSum(with_a_trifle);
  }
  EXPECT_EQ(sum.value(), 0x1p62);
  FixedPointSum same = sum;
  same.add(0x1p-386);  // 2^62 units
  EXPECT_EQ(with_a_trifle, same) << "nothing is lost beside a large sum";
}

// A state that was damaged on disk once held the only sum that is its own opposite, and its value was sought for ever.
TEST(FixedPointSum, HoldsSumsOfEverySize) {
  FixedPointSum::Words size{};
  for (std::size_t k = 0; k < size.size(); ++k) {
    for (const unsigned bit : {0u, 1u, 62u, 63u}) {
      if (k + 1 == size.size() && bit == 63u) continue;  // the sign's
      size = {};
      size[k] = std::uint64_t{1} << bit;
      for (const bool is_negative : {false, true}) {
        const FixedPointSum sum(is_negative, size);
        EXPECT_EQ(sum.value(), std::ldexp(is_negative ? -1.0 : 1.0, static_cast<int>(64 * k + bit) - 448));
        EXPECT_EQ(sum.is_negative(), is_negative);
        EXPECT_EQ(sum.size_in_units(), size);
        EXPECT_EQ(FixedPointSum(sum) += FixedPointSum(!is_negative, size), FixedPointSum{});
      }
    }
  }
  // What is added to the largest sum reaches the sign: the only number that is its own opposite has a value, too.
  size.fill(~std::uint64_t{0});
  size.back() >>= 1;
  FixedPointSum beyond(true, size);
  beyond.add(-FixedPointSum::kUnit);
  EXPECT_EQ(beyond.value(), -0x1p127);
}

// The squares of 2^17 of an integrand's largest values were once more than there was room for: a negative sum.
TEST(FixedPointSum, HasRoomForTheLargestNumbersOfARun) {
  FixedPointSum sum;
  for (int k = 0; k < 1024; ++k) sum.add(FixedPointSum::kLargest);
  for (int k = 0; k < 52; ++k) sum += FixedPointSum(sum);
  EXPECT_EQ(sum.value(), 0x1p110);
}

TEST(FixedPointSum, TakesNegativeNumbersToo) {
  std::vector<double> numbers = numbers_down_to(-460, 3000, 5);
  for (std::size_t k = 0; k < numbers.size(); k += 2) numbers[k] = -std::ldexp(numbers[k], static_cast<int>(k % 40));
  const FixedPointSum sum = sum_of(numbers);
  EXPECT_LT(sum.value(), 0.0);
  EXPECT_LE(error_in_u(sum, exact_sum(numbers)), 2.001);
  FixedPointSum at_once;
  at_once.add(numbers);
  EXPECT_EQ(at_once, sum);
  std::reverse(numbers.begin(), numbers.end());
  EXPECT_EQ(sum_of(numbers), sum);
  for (double& x : numbers) x = -x;
  FixedPointSum nothing = sum;
  nothing += sum_of(numbers);
  EXPECT_EQ(nothing, FixedPointSum());
  EXPECT_EQ(sum_of({FixedPointSum::kLargest, -1.0}).value(), FixedPointSum::kLargest - 1.0);
  EXPECT_EQ(sum_of({-FixedPointSum::kUnit}).value(), -FixedPointSum::kUnit);
}

TEST(FixedPointSum, OfManyOnesIsTheirNumber) {
  FixedPointSum sum;
  for (int k = 0; k < 1000003; ++k) sum.add(1.0);
  EXPECT_EQ(sum.value(), 1000003.0);
}

}  // namespace
}  // namespace vex

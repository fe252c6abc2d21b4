#include "engine/numeric/interval.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>
#include <vector>

namespace vex {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(NextDouble, IsThatOfTheStandardLibrary) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values = {0.0,
                                -0.0,
                                1.0,
                                -1.0,
                                HUGE_VAL,
                                -HUGE_VAL,
                                Limits::max(),
                                Limits::lowest(),
                                0x1p-1022,
                                -0x1p-1022,
                                0x1p-1023,
                                -0x1p-1023,
                                2.0,
                                Limits::min(),
                                Limits::denorm_min(),
                                0.5 + 0.25,
                                -Limits::denorm_min()};
  std::mt19937_64 random(7);
  while (values.size() < 200'000) values.push_back(std::bit_cast<double>(random()));
  for (const double x : values) {
    if (x != x) {
      EXPECT_TRUE(std::isnan(next_below(x)) && std::isnan(next_above(x)));
      continue;
    }
    EXPECT_EQ(bits(next_below(x)), bits(std::nextafter(x, -HUGE_VAL))) << x;
    EXPECT_EQ(bits(next_above(x)), bits(std::nextafter(x, HUGE_VAL))) << x;
  }
}

}  // namespace
}  // namespace vex

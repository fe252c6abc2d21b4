#include "shapes/formula.h"

#include <gtest/gtest.h>

namespace vex {
namespace {

TEST(AverageExcludedVolume, IsSymmetricAndAddsUp) {
  const Measures a{1, 6, 9.42}, b{2, 9, 11};
  EXPECT_DOUBLE_EQ(average_excluded_volume(a, b), average_excluded_volume(b, a));
  EXPECT_NEAR(average_excluded_volume(a, b), 3 + (9.42 * 9 + 11 * 6) / (4 * std::numbers::pi), 1e-12);
  EXPECT_DOUBLE_EQ(second_virial_coefficient(11.0), 5.5);
}

TEST(AverageExcludedVolume, OfTwoBallsIsTheBallOfTheSumOfRadii) {
  const auto ball = [](double r) {
    return Measures{4.0 / 3 * std::numbers::pi * r * r * r, 4 * std::numbers::pi * r * r, 4 * std::numbers::pi * r};
  };
  EXPECT_NEAR(average_excluded_volume(ball(1), ball(2)), 4.0 / 3 * std::numbers::pi * 27, 1e-12);
}

TEST(ReducedExcludedVolume, IsNoNumberForAFlatBody) {
  EXPECT_TRUE(std::isnan(reduced_excluded_volume(3.0, {0, 2, 3}, {1, 6, 9})));
  EXPECT_NEAR(reduced_excluded_volume(11e-200, {1e-200, 1, 1}, {1e-200, 1, 1}), 11.0, 1e-13)
      << "no underflow on the way";
}

}  // namespace
}  // namespace vex

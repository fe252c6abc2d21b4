#include "shapes/nematic/fixed_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vex {
namespace {

// Rounds until none is off by more than 1e-13, or `most`.
template <class Map>
int rounds(const Map& of, std::vector<double>* x, int most) {
  FixedPoint fixed_point;
  for (int round = 1; round <= most; ++round) {
    if (fixed_point.step(*x, of(*x)) <= 1e-13) return round;
  }
  return most;
}

TEST(FixedPoint, OfWhatIsLinearTakesAsManyRoundsAsThereAreSlopes) {
  // By substitution slopes of .999 take 23 000 rounds, and a slope of -1.2 goes away from the fixed point.
  const std::vector<double> slopes = {0.999, -1.2, 0.5, -0.3, 0.97};
  const auto map = [&](const std::vector<double>& x) {
    std::vector<double> y;
    for (std::size_t k = 0; k < x.size(); ++k) y.push_back(1.0 + slopes[k] * (x[k] - 1.0));
    return y;
  };
  std::vector<double> x = {1.001, 0.999, 1.0005, 0.9995, 1.002};
  EXPECT_LT(rounds(map, &x, 1000), 30);
  for (const double value : x) EXPECT_NEAR(value, 1.0, 1e-9);
}

TEST(FixedPoint, IsFoundWhereSubstitutionSwings) {
  // x = cos 1.6 y, y = sin 1.3 x, from afar, where nothing is linear.
  const auto map = [](const std::vector<double>& x) {
    return std::vector<double>{std::cos(1.6 * x[1]), std::sin(1.3 * x[0])};
  };
  std::vector<double> x = {2.0, -1.0};
  EXPECT_LT(rounds(map, &x, 1000), 200);
  EXPECT_NEAR(x[0], std::cos(1.6 * x[1]), 1e-12);
  EXPECT_NEAR(x[1], std::sin(1.3 * x[0]), 1e-12);
}

TEST(FixedPoint, KnowsThatItIsThere) {
  std::vector<double> x = {0.25, -3.0};
  FixedPoint fixed_point;
  EXPECT_EQ(fixed_point.step(x, {0.25, -3.0}), 0.0);
  EXPECT_EQ(x, (std::vector<double>{0.25, -3.0}));
}

}  // namespace
}  // namespace vex

#include "engine/sampling/percolation/crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// Numbers of bodies of three axes that differ, the threshold at a density of 1 a volume, spreads as sizes have.
std::vector<WrappingNumbers> numbers_of_size(std::mt19937_64& random, double size, std::size_t n) {
  const double volume = 40.0 * size * size * size, spread = 0.45 * volume * std::pow(size, -1.141);
  const std::array<double, 3> off = {-0.3, -0.3, 1.1};  // in spreads: R at the threshold is .62, .62, .14
  std::normal_distribution<double> normal;
  std::vector<WrappingNumbers> numbers(n);
  for (WrappingNumbers& one : numbers) {
    const double common = normal(random);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = off[axis] + 0.7 * common + 0.714 * normal(random);
      one.along[axis] = static_cast<std::uint32_t>(std::lround(std::fmax(1.0, volume + spread * at)));
    }
  }
  return numbers;
}

Crossing crossing_of(std::mt19937_64& random, std::span<const double> sizes, std::size_t n) {
  std::vector<std::vector<WrappingNumbers>> numbers;
  for (const double size : sizes) numbers.push_back(numbers_of_size(random, size, n));
  std::vector<SizedRealisations> sized;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sized.push_back({sizes[k], 40.0 * sizes[k] * sizes[k] * sizes[k], numbers[k]});
  }
  return find_crossing(sized);
}

TEST(Crossing, FindsWhereSizesCrossWithItsError) {
  std::mt19937_64 random(5);
  double squares = 0.0, p = 0.0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const Crossing found = crossing_of(random, std::array{3.0, 5.0, 8.0}, 400);
    const double z = (found.threshold.density - 1.0) / found.threshold.std_error;
    squares += z * z / kRuns;
    p += found.threshold.p_value / kRuns;
    EXPECT_NEAR(found.probability[0], 0.6, 0.35);
    EXPECT_NEAR(found.probability[2], 0.14, 0.25);
    EXPECT_TRUE(found.threshold.without_smallest.has_value());
    ASSERT_EQ(found.sizes.size(), 3u);
    for (const Crossing::OfSize& size : found.sizes) EXPECT_GT(size.std_error[0], 0.0);
  }
  EXPECT_LT(squares, 1.0 + 5.0 * std::sqrt(2.0 / kRuns));
  EXPECT_GT(squares, 0.2);
  EXPECT_GT(p, 0.3);
}

// Sizes with thresholds of their own, far from each other: R of all of them is 0 or 1 at most densities, where any
// threshold fits. Such a fit is no answer.
TEST(Crossing, SizesThatDoNotCrossHaveNone) {
  std::mt19937_64 random(6);
  std::vector<WrappingNumbers> small = numbers_of_size(random, 3.0, 1000), large = numbers_of_size(random, 8.0, 1000);
  for (WrappingNumbers& one : small) {
    for (std::uint32_t& axis : one.along) axis += 2000;
  }
  const std::vector<SizedRealisations> sized = {{3.0, 40.0 * 27.0, small}, {8.0, 40.0 * 512.0, large}};
  EXPECT_TRUE([&] {
    try {
      return find_crossing(sized).threshold.p_value < 1e-3;
    } catch (const UsageError&) {
      return true;
    }
  }());
}

TEST(Crossing, RefusesOneSizeAndFewRealisations) {
  std::mt19937_64 random(7);
  EXPECT_THROW(crossing_of(random, std::array{3.0}, 400), UsageError);
  EXPECT_THROW(crossing_of(random, std::array{3.0, 5.0}, kFewestRealisations - 1), UsageError);
  EXPECT_NO_THROW(crossing_of(random, std::array{3.0, 5.0}, 400));
}

}  // namespace
}  // namespace vex

#include "engine/sampling/percolation/threshold.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/sampling/percolation/extrapolation.h"

namespace vex {
namespace {

TEST(WrappingProbability, IsThatOfAPoissonNumberOfBodies) {
  for (const std::uint32_t n : {1u, 2u, 30u, 1000u, 200000u}) {
    const std::vector<WrappingNumbers> one = {{{n, n + 3, n + 10}}};
    for (const double part : {0.5, 0.97, 1.0, 1.02, 1.5}) {
      const double lambda = part * n;
      const auto at_least = [lambda](std::uint32_t k) { return boost::math::gamma_p(static_cast<double>(k), lambda); };
      EXPECT_NEAR(wrapping_probability(one, WrappingCriterion::any, lambda), at_least(n), 1e-12);
      EXPECT_NEAR(wrapping_probability(one, WrappingCriterion::all, lambda), at_least(n + 10), 1e-12);
      EXPECT_NEAR(wrapping_probability(one, WrappingCriterion::x, lambda),
                  (at_least(n) + at_least(n + 3) + at_least(n + 10)) / 3.0, 1e-12);
    }
  }
}

// A normal distribution of each axis, correlated between them.
std::vector<WrappingNumbers> random_numbers(std::mt19937_64& random, std::size_t n, double mean, double spread) {
  std::normal_distribution<double> normal;
  std::vector<WrappingNumbers> numbers(n);
  for (WrappingNumbers& one : numbers) {
    const double common = normal(random);
    for (std::uint32_t& axis : one.along) {
      axis = static_cast<std::uint32_t>(std::lround(mean + spread * (0.7 * common + 0.714 * normal(random))));
    }
  }
  return numbers;
}

TEST(SizeThreshold, IsWhereTheProbabilityHasItsUniversalValue) {
  std::mt19937_64 random(3);
  const std::vector<WrappingNumbers> numbers = random_numbers(random, 500, 2000.0, 150.0);
  const SizeThreshold threshold = size_threshold(numbers);
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    const WrappingCriterion criterion = static_cast<WrappingCriterion>(c);
    const double goal = universal_probability(criterion).value;
    EXPECT_NEAR(wrapping_probability(numbers, criterion, threshold.lambda[c]), goal, 1e-9);
    const double step = 1.0;
    const double slope = (wrapping_probability(numbers, criterion, threshold.lambda[c] + step) - goal) / step;
    EXPECT_NEAR(threshold.universal_error[c] * slope, universal_probability(criterion).std_error,
                0.01 * universal_probability(criterion).std_error);
  }
}

TEST(SizeThreshold, TellsTheScatterOfItsEstimates) {
  std::mt19937_64 random(4);
  constexpr int kRuns = 400;
  std::array<double, kNWrappingCriteria> sum{}, squares{}, told{};
  double product = 0.0, told_product = 0.0;
  for (int k = 0; k < kRuns; ++k) {
    const SizeThreshold threshold = size_threshold(random_numbers(random, 300, 2000.0, 150.0));
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      sum[c] += threshold.lambda[c];
      squares[c] += threshold.lambda[c] * threshold.lambda[c];
      told[c] += threshold.covariance[c][c] / kRuns;
    }
    product += threshold.lambda[0] * threshold.lambda[1];
    told_product += threshold.covariance[0][1] / kRuns;
  }
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    const double variance = squares[c] / kRuns - (sum[c] / kRuns) * (sum[c] / kRuns);
    EXPECT_NEAR(variance / told[c], 1.0, 5.0 * std::sqrt(2.0 / kRuns));
  }
  const double covariance = product / kRuns - (sum[0] / kRuns) * (sum[1] / kRuns);
  EXPECT_NEAR(covariance / told_product, 1.0, 0.35);
}

TEST(SizeThreshold, FewRealisationsAreNone) {
  std::mt19937_64 random(5);
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}, kFewestRealisations - 1}) {
    EXPECT_THROW(size_threshold(random_numbers(random, n, 2000.0, 150.0)), UsageError) << n;
  }
  EXPECT_NO_THROW(size_threshold(random_numbers(random, kFewestRealisations, 2000.0, 150.0)));
}

// The covariance of three criteria was once inverted of two realisations, and thresholds were thousands of errors off.
TEST(Extrapolation, CriteriaOfOneEventDoNotWeighWithoutEnd) {
  std::vector<WrappingNumbers> numbers(60);
  for (std::uint32_t k = 0; k < numbers.size(); ++k) numbers[k].along = {100 + k, 100 + k, 100 + k};
  std::vector<SizedThreshold> sizes;
  for (const double size : {3.0, 4.0, 6.0}) {
    sizes.push_back(sized_threshold(size_threshold(numbers), size, size * size * size));
  }
  const Extrapolation found = extrapolate(sizes);
  EXPECT_TRUE(std::isfinite(found.density));
  EXPECT_TRUE(found.std_error > 0.0 && std::isfinite(found.std_error));
  EXPECT_TRUE(found.p_value >= 0.0 && found.p_value <= 1.0);
}

// Thresholds with these amplitudes and a covariance that shrinks with the size.
std::vector<SizedThreshold> sized(std::span<const double> sizes, double density, const std::array<double, 3>& amplitude,
                                  double exponent = kSizeExponent) {
  std::vector<SizedThreshold> all;
  for (const double size : sizes) {
    SizedThreshold one;
    one.size = size;
    for (std::size_t c = 0; c < 3; ++c) {
      one.density[c] = density + amplitude[c] * std::pow(size, -exponent);
      for (std::size_t d = 0; d < 3; ++d) one.covariance[c][d] = (c == d ? 1.0 : 0.6) * 1e-8 * std::pow(size, -2.2);
      one.universal_error[c] = 1e-7;
    }
    all.push_back(one);
  }
  return all;
}

TEST(Extrapolation, FindsTheThresholdBehindItsSizes) {
  const std::array<double, 3> amplitude = {0.3, -0.2, 0.05};
  const Extrapolation found = extrapolate(sized(std::array{4.0, 6.0, 8.0, 10.0}, 0.25, amplitude));
  EXPECT_TRUE(found.is_extrapolated);
  EXPECT_NEAR(found.density, 0.25, 1e-10);
  EXPECT_NEAR(found.chi_square, 0.0, 1e-9);
  EXPECT_EQ(found.degrees_of_freedom, 8);
  EXPECT_NEAR(found.p_value, 1.0, 1e-6);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found.amplitude[c], amplitude[c], 1e-6);
  ASSERT_TRUE(found.without_smallest.has_value());
  EXPECT_NEAR(*found.without_smallest, 0.25, 1e-9);
  EXPECT_NEAR(found.exponent, kSizeExponent, 1e-5);
  EXPECT_GT(found.offset_error, 0.0);
  EXPECT_GE(found.std_error, std::hypot(found.scatter_error, found.offset_error));
}

TEST(Extrapolation, FindsTheThresholdBehindBothTerms) {
  std::vector<SizedThreshold> data = sized(std::array{4.0, 6.0, 16.0}, 0.25, {0.01, 0.02, -0.01});
  for (SizedThreshold& one : data) {
    for (double& density : one.density) density += 0.13 * std::pow(one.size, -kNextSizeExponent);
  }
  const Extrapolation found = extrapolate(data);
  // What is known of b beforehand draws it to 0, by next to nothing where the sizes tell it.
  EXPECT_NEAR(found.density, 0.25, 0.5 * found.std_error);
  EXPECT_EQ(found.degrees_of_freedom, 5);
}

TEST(Extrapolation, LearnsTheExponentWhereTheSizesTellIt) {
  // These errors determine theta to less than a tenth: what is known of it beforehand weighs little.
  const std::array<double, 3> amplitude = {0.3, -0.2, 0.05};
  const Extrapolation found = extrapolate(sized(std::array{4.0, 10.0}, 0.25, amplitude, kSizeExponent + 0.2));
  EXPECT_LT(found.exponent_std_error, 0.1);
  EXPECT_NEAR(found.exponent, kSizeExponent + 0.2, 0.2 * kSizeExponentError);
  EXPECT_NEAR(found.density, 0.25, 0.5 * found.std_error);
  // Without amplitudes nothing does.
  const Extrapolation without = extrapolate(sized(std::array{4.0, 6.0, 10.0}, 0.25, {}));
  EXPECT_NEAR(without.exponent_std_error, kSizeExponentError, 1e-9);
}

TEST(Extrapolation, OneSizeIsTakenAsItIs) {
  const Extrapolation found = extrapolate(sized(std::array{8.0}, 0.25, {}));
  EXPECT_FALSE(found.is_extrapolated);
  EXPECT_NEAR(found.density, 0.25, 1e-12);
  EXPECT_EQ(found.degrees_of_freedom, 2);
  EXPECT_THROW(extrapolate({}), UsageError);
}

TEST(Extrapolation, ItsErrorIsThatOfItsScatter) {
  // Data with noise of the covariance that is told, and with an exponent that is off by what is told: the residual over
  // the error has the variance 1, and chi^2 its mean, whether the data determine the exponent or not.
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  constexpr int kRuns = 1000;
  for (const double amplitude : {0.01, 0.1}) {
    double sum = 0.0, chi_square = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<SizedThreshold> data = sized(std::array{4.0, 6.0, 10.0}, 0.25, {amplitude, amplitude, amplitude},
                                               kSizeExponent + kSizeExponentError * normal(random));
      std::array<double, 3> next;
      for (double& b : next) b = kNextAmplitudeError * 0.25 * normal(random);
      for (SizedThreshold& one : data) {
        for (std::size_t c = 0; c < 3; ++c) one.density[c] += next[c] * std::pow(one.size, -kNextSizeExponent);
        const double common = normal(random);
        for (std::size_t c = 0; c < 3; ++c) {
          one.density[c] +=
              std::sqrt(one.covariance[c][c]) * (std::sqrt(0.6) * common + std::sqrt(0.4) * normal(random));
        }
      }
      const Extrapolation found = extrapolate(data);
      const double off = (found.density - 0.25) / std::hypot(found.scatter_error, found.offset_error);
      sum += off * off / kRuns;
      chi_square += found.chi_square / kRuns;
    }
    EXPECT_NEAR(sum, 1.0, 5.0 * std::sqrt(2.0 / kRuns));
    EXPECT_NEAR(chi_square, 5.0, 5.0 * std::sqrt(10.0 / kRuns));
  }
}

}  // namespace
}  // namespace vex

#include "engine/sampling/points/sobol.h"

#include <gtest/gtest.h>

#include <bit>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace vex {
namespace {

using CubePoint = std::vector<double>;

// The first 2^m of a scrambling.
std::vector<CubePoint> scrambling(const SobolPoints& points, int m, std::uint64_t seed, std::uint64_t replicate,
                                  std::uint64_t first = 0) {
  const SobolPoints::Scrambling keys = points.scrambling(seed, replicate);
  std::vector<CubePoint> all(std::size_t{1} << m, CubePoint(static_cast<std::size_t>(points.dimension())));
  for (std::size_t i = 0; i < all.size(); ++i) points.scrambled(keys, first + i, all[i]);
  return all;
}

double mean_of(const std::vector<CubePoint>& points, const std::function<double(const CubePoint&)>& f) {
  double sum = 0.0;
  for (const CubePoint& p : points) sum += f(p);
  return sum / static_cast<double>(points.size());
}

/// The standard error of one scrambling's mean, from the spread over many, about the true mean.
double spread(const std::function<double(const CubePoint&)>& f, double truth, int dimension, int log2_n, double* z) {
  const SobolPoints points(dimension);
  constexpr int kReplicates = 64;
  double sum = 0.0, sum_sq = 0.0;
  for (int r = 0; r < kReplicates; ++r) {
    const double off = mean_of(scrambling(points, log2_n, 7, static_cast<std::uint64_t>(r)), f) - truth;
    sum += off;
    sum_sq += off * off;
  }
  const double variance = (sum_sq - sum * sum / kReplicates) / (kReplicates - 1);
  *z = sum / kReplicates / std::sqrt(variance / kReplicates);
  return std::sqrt(variance);
}

TEST(Sobol, KeepsEveryCoordinateStratifiedWhenScrambled) {
  const std::vector<CubePoint> all = scrambling(SobolPoints(11), 10, 1, 0);
  for (std::size_t d = 0; d < 11; ++d) {
    std::set<int> intervals;
    for (const CubePoint& p : all) intervals.insert(static_cast<int>(p[d] * 1024));
    EXPECT_EQ(intervals.size(), 1024u) << "coordinate " << d;
  }
}

TEST(Sobol, HasOnePointInEveryElementaryRectangleOfTheFirstTwoCoordinates) {
  constexpr int kLog2 = 10;
  const SobolPoints points(2);
  for (const std::uint64_t replicate : {0u, 1u, 2u}) {
    // Also of those that follow.
    const std::vector<CubePoint> all = scrambling(points, kLog2, 42, replicate, replicate << kLog2);
    for (int across = 0; across <= kLog2; ++across) {
      std::set<std::pair<int, int>> rectangles;
      for (const CubePoint& p : all) {
        rectangles.insert(
            {static_cast<int>(std::ldexp(p[0], across)), static_cast<int>(std::ldexp(p[1], kLog2 - across))});
      }
      EXPECT_EQ(rectangles.size(), all.size()) << across << " bits of the first coordinate";
    }
  }
}

TEST(Sobol, NeverDrawsAnEndOfTheUnitInterval) {
  for (const int log2_n : {0, 1, 12}) {
    for (const CubePoint& p : scrambling(SobolPoints(8), log2_n, 3, 5)) {
      for (const double x : p) {
        EXPECT_GT(x, 0.0);
        EXPECT_LT(x, 1.0);
        EXPECT_EQ(std::fmod(x * 0x1p53, 2.0), 1.0);
      }
    }
  }
}

TEST(Sobol, IsAFunctionOfSeedReplicateAndIndex) {
  const SobolPoints points(5);
  EXPECT_EQ(scrambling(points, 6, 1, 2), scrambling(SobolPoints(5), 6, 1, 2));
  EXPECT_NE(scrambling(points, 6, 1, 2), scrambling(points, 6, 1, 3));
  EXPECT_NE(scrambling(points, 6, 1, 2), scrambling(points, 6, 2, 2));
}

TEST(Sobol, ScramblesEachCoordinateIndependently) {
  // A single point is uniform in the cube: over many replicates its coordinates have mean 1/2, variance 1/12, and no
  // correlation with each other, with the next replicate's or with another seed's.
  const SobolPoints points(3);
  constexpr int kReplicates = 40000;
  CubePoint sum(3), sum_sq(3), p(3), next(3), other(3);
  double xy = 0.0, xz = 0.0, with_next = 0.0, with_other = 0.0;
  for (std::uint64_t r = 0; r < kReplicates; ++r) {
    points.scrambled(points.scrambling(11, r), 5, p);
    points.scrambled(points.scrambling(11, r + 1), 5, next);
    points.scrambled(points.scrambling(12, r), 5, other);
    for (std::size_t d = 0; d < 3; ++d) {
      sum[d] += p[d] - 0.5;
      sum_sq[d] += (p[d] - 0.5) * (p[d] - 0.5);
    }
    xy += (p[0] - 0.5) * (p[1] - 0.5);
    xz += (p[0] - 0.5) * (p[2] - 0.5);
    with_next += (p[0] - 0.5) * (next[0] - 0.5);
    with_other += (p[0] - 0.5) * (other[0] - 0.5);
  }
  const double root = std::sqrt(static_cast<double>(kReplicates));
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_LE(std::fabs(sum[d]), 4.0 * root * std::sqrt(1.0 / 12.0));
    EXPECT_LE(std::fabs(sum_sq[d] - kReplicates / 12.0), 4.0 * root * std::sqrt(1.0 / 180.0));
  }
  for (const double product : {xy, xz, with_next, with_other}) EXPECT_LE(std::fabs(product), 4.0 * root / 12.0);
}

struct TestFunction {
  const char* name;
  std::function<double(const CubePoint&)> f;
  double truth;
};

TEST(Sobol, ConvergesFasterThanRandomPointsAndIsUnbiased) {
  const std::vector<TestFunction> integrands = {
      {"smooth", [](const CubePoint& p) { return std::exp(p[0] + p[1] * p[2] - 0.5 * p[3]) * std::cos(p[4]); }, 0.0},
      {"kinked", [](const CubePoint& p) { return std::fabs(p[0] + p[1] + p[2] + p[3] - 2.0); }, 7.0 / 15.0},
  };
  // The smooth one's truth: of e^x, of e^(yz) (the sum of 1 / (k! (k + 1)^2)), of e^(-z/2) and of cos, one by one.
  double of_product = 0.0, term = 1.0;
  for (int k = 0; k < 20; ++k) {
    of_product += term / ((k + 1.0) * (k + 1.0));
    term /= k + 1.0;
  }
  const double smooth = (std::numbers::e - 1.0) * of_product * 2.0 * (1.0 - std::exp(-0.5)) * std::sin(1.0);
  for (const TestFunction& integrand : integrands) {
    const double truth = integrand.truth == 0.0 ? smooth : integrand.truth;
    double z_coarse = 0.0, z_fine = 0.0;
    const double coarse = spread(integrand.f, truth, 5, 6, &z_coarse);
    const double fine = spread(integrand.f, truth, 5, 12, &z_fine);
    EXPECT_LE(std::log2(fine / coarse) / 6.0, -0.8) << integrand.name;
    EXPECT_LE(std::fabs(z_coarse), 4.0) << integrand.name;
    EXPECT_LE(std::fabs(z_fine), 4.0) << integrand.name;
  }
}

// Without scrambling: the points of Boost, which come in Gray code's order.
TEST(Sobol, ScramblesThePointsOfBoost) {
  constexpr int kDimension = 9;
  const SobolPoints points(kDimension);
  boost::random::sobol_engine<std::uint64_t, 32> sequence(kDimension);
  for (std::uint64_t n = 1; n < 5000; ++n) {
    const std::uint64_t index = n ^ n >> 1;
    for (std::size_t d = 0; d < kDimension; ++d) {
      const std::uint32_t bits =
          points.low_bits(d)[index % SobolPoints::kLow] ^ points.high_bits(d, index / SobolPoints::kLow);
      ASSERT_EQ(SobolPoints::reversed(bits), sequence()) << "point " << n << ", coordinate " << d;
    }
  }
  sequence.seed((std::uint64_t{1} << 32) - 2);  // the last of all
  const std::uint64_t index = (std::uint64_t{1} << 32) - 1, gray = index ^ index >> 1;
  for (std::size_t d = 0; d < kDimension; ++d) {
    const std::uint32_t bits =
        points.low_bits(d)[gray % SobolPoints::kLow] ^ points.high_bits(d, gray / SobolPoints::kLow);
    EXPECT_EQ(SobolPoints::reversed(bits), sequence()) << "coordinate " << d;
  }
}

// Nested: points that agree in their first k bits, and differ in the next, still do when scrambled.
TEST(Sobol, KeepsHowManyBitsTwoPointsShare) {
  std::mt19937_64 random(1);
  const SobolPoints points(1);
  for (std::uint64_t replicate = 0; replicate < 100; ++replicate) {
    const SobolPoints::Keys keys = points.scrambling(3, replicate)[0];
    for (int k = 0; k < 200; ++k) {
      const auto x = static_cast<std::uint32_t>(random()), y = x ^ static_cast<std::uint32_t>(random()) << (k % 32);
      ASSERT_EQ(std::countr_zero(x ^ y), std::countr_zero(SobolPoints::nested(x, keys) ^ SobolPoints::nested(y, keys)));
    }
  }
}

}  // namespace
}  // namespace vex

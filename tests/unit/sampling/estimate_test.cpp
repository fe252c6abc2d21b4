#include "engine/sampling/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vex {
namespace {

Tally tally_of(std::uint64_t trials, std::uint64_t hits, std::uint64_t undecided = 0) {
  Tally tally;
  tally.n_trials = trials;
  tally.n_hits = hits;
  tally.n_undecided = undecided;
  return tally;
}

TEST(WilsonInterval, GivesThePublishedValues) {
  // 81 of 263 at z = 1.96: 0.2553 ... 0.3662 (Newcombe, Statistics in Medicine 17, 857, 1998, method 3).
  const Interval95 interval = wilson_interval(81, 263, 1.959963984540054);
  EXPECT_NEAR(interval.lower, 0.2553, 5e-5);
  EXPECT_NEAR(interval.upper, 0.3662, 5e-5);
  // 0 of 20: 0 ... 0.1611; 1 of 29: 0.0061 ... 0.1718.
  EXPECT_EQ(wilson_interval(0, 20, 1.959963984540054).lower, 0.0);
  EXPECT_NEAR(wilson_interval(0, 20, 1.959963984540054).upper, 0.1611, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29, 1.959963984540054).lower, 0.0061, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29, 1.959963984540054).upper, 0.1718, 5e-5);
  EXPECT_EQ(wilson_interval(20, 20, 1.0).upper, 1.0);
}

TEST(WilsonInterval, HoldsTheTruthNinetyFivePercentOfTheTime) {
  std::mt19937_64 random(1);
  for (const double p : {0.5, 0.1, 0.01}) {
    constexpr int runs = 4000, n = 2000;
    int held = 0;
    std::binomial_distribution<int> draw(n, p);
    for (int k = 0; k < runs; ++k) {
      const Interval95 interval = wilson_interval(static_cast<std::uint64_t>(draw(random)), n, 1.959963984540054);
      held += interval.lower <= p && p <= interval.upper ? 1 : 0;
    }
    // The coverage of a discrete law oscillates by about a percent around 95 %.
    EXPECT_NEAR(static_cast<double>(held) / runs, 0.95, 0.01 + 4.5 * std::sqrt(0.95 * 0.05 / runs)) << p;
  }
}

TEST(HitOrMissEstimate, IsTheBinomialOne) {
  const VolumeEstimate estimate = hit_or_miss_estimate(tally_of(10000, 2500), 8.0);
  EXPECT_DOUBLE_EQ(estimate.excluded_volume, 2.0);
  EXPECT_NEAR(estimate.std_error, 8.0 * std::sqrt(0.25 * 0.75 / 10000), 1e-15);
  EXPECT_LT(estimate.ci95.lower, 2.0);
  EXPECT_GT(estimate.ci95.upper, 2.0);
}

TEST(HitOrMissEstimate, NeverClaimsAnErrorOfZero) {
  for (const std::uint64_t hits : {0ull, 1000ull}) {
    const VolumeEstimate estimate = hit_or_miss_estimate(tally_of(1000, hits), 8.0);
    EXPECT_GT(estimate.std_error, 0.0);
    EXPECT_NEAR(estimate.std_error, 8.0 * 0.5 / 1001, 1e-12);  // Wilson's half-width at z = 1: (1/2n) / (1 + 1/n)
    EXPECT_TRUE(std::isfinite(estimate.excluded_volume));
  }
  EXPECT_TRUE(std::isinf(hit_or_miss_estimate(tally_of(1000, 0), 8.0).relative_error()));
  // So many trials that the binomial error is below rounding.
  const VolumeEstimate certain = hit_or_miss_estimate(tally_of(1ull << 62, 1ull << 62), 1.0);
  EXPECT_GE(certain.std_error, 0x1p-53);
}

TEST(HitOrMissEstimate, UndecidedTrialsWidenTheIntervalAndAreNeitherHitsNorMisses) {
  const VolumeEstimate with = hit_or_miss_estimate(tally_of(10000, 2500, 1000), 1.0);
  EXPECT_DOUBLE_EQ(with.excluded_volume, 0.3);
  EXPECT_LE(with.ci95.lower, hit_or_miss_estimate(tally_of(10000, 2500), 1.0).ci95.lower);
  EXPECT_GE(with.ci95.upper, hit_or_miss_estimate(tally_of(10000, 3500), 1.0).ci95.upper);
  EXPECT_GE(with.std_error, 0.05);
  // All undecided: anything between nothing and everything.
  const VolumeEstimate nothing = hit_or_miss_estimate(tally_of(1000, 0, 1000), 1.0);
  EXPECT_EQ(nothing.ci95.lower, 0.0);
  EXPECT_EQ(nothing.ci95.upper, 1.0);
}

}  // namespace
}  // namespace vex

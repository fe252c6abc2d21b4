#include "engine/sampling/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

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

// A tally of a fitted domain from trials given one by one.
struct Trial {
  double share;
  Outcome outcome;
};

Verdict verdict_of(Outcome outcome) {
  if (outcome == Outcome::overlap) return Verdict::overlap(DecidedBy::gjk);
  if (outcome == Outcome::disjoint) return Verdict::disjoint(DecidedBy::gjk);
  return Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
}

Tally tally_of(const std::vector<Trial>& trials) {
  Tally tally;
  for (const Trial& trial : trials) tally.add(verdict_of(trial.outcome), trial.share);
  return tally;
}

Outcome hit_if(bool hits) { return hits ? Outcome::overlap : Outcome::disjoint; }

double in_unit_interval(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Mean and standard error of numbers, by the textbook.
struct Direct {
  double mean = 0.0, std_error = 0.0;
};
Direct direct(const std::vector<double>& numbers) {
  const double n = static_cast<double>(numbers.size());
  Direct result;
  for (const double x : numbers) result.mean += x / n;
  double squares = 0.0;
  for (const double x : numbers) squares += (x - result.mean) * (x - result.mean);
  result.std_error = std::sqrt(squares / (n - 1.0) / n);
  return result;
}

TEST(FittedEstimate, IsTheMeanOfTheVolumesOfTheHitsWithItsSampleError) {
  std::mt19937_64 random(2);
  std::vector<Trial> trials;
  std::vector<double> numbers;
  for (int k = 0; k < 5000; ++k) {
    const double share = in_unit_interval(random);
    const bool hits = in_unit_interval(random) < 0.3 + 0.5 * share;
    trials.push_back({share, hit_if(hits)});
    numbers.push_back(hits ? 8.0 * share : 0.0);
  }
  const VolumeEstimate found = fitted_estimate(tally_of(trials), 8.0);
  const Direct expected = direct(numbers);
  EXPECT_NEAR(found.excluded_volume, expected.mean, 1e-12 * expected.mean);
  EXPECT_NEAR(found.std_error, expected.std_error, 1e-10 * expected.std_error);
  EXPECT_NEAR(found.ci95.lower, expected.mean - 1.959963984540054 * expected.std_error, 1e-9);
  EXPECT_NEAR(found.ci95.upper, expected.mean + 1.959963984540054 * expected.std_error, 1e-9);
}

TEST(FittedEstimate, UndecidedTrialsAreNeitherHitsNorMisses) {
  std::mt19937_64 random(3);
  std::vector<Trial> trials, hits, misses;
  std::vector<double> middle;
  double undecided = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const double share = 0.2 + 0.8 * in_unit_interval(random);
    const double roll = in_unit_interval(random);
    const Outcome outcome = roll < 0.5 ? Outcome::overlap : roll < 0.6 ? Outcome::undecided : Outcome::disjoint;
    trials.push_back({share, outcome});
    hits.push_back({share, outcome == Outcome::undecided ? Outcome::overlap : outcome});
    misses.push_back({share, outcome == Outcome::undecided ? Outcome::disjoint : outcome});
    middle.push_back(outcome == Outcome::overlap ? share : outcome == Outcome::undecided ? 0.5 * share : 0.0);
    if (outcome == Outcome::undecided) undecided += share;
  }
  const VolumeEstimate found = fitted_estimate(tally_of(trials), 1.0);
  const Direct expected = direct(middle);
  EXPECT_NEAR(found.excluded_volume, expected.mean, 1e-12);
  EXPECT_NEAR(found.std_error, std::hypot(expected.std_error, 0.5 * undecided / 4000), 1e-12);
  EXPECT_NEAR(found.ci95.lower, fitted_estimate(tally_of(misses), 1.0).ci95.lower, 1e-3);
  EXPECT_NEAR(found.ci95.upper, fitted_estimate(tally_of(hits), 1.0).ci95.upper, 1e-3);
  EXPECT_LT(found.ci95.lower, fitted_estimate(tally_of(misses), 1.0).excluded_volume);
  EXPECT_GT(found.ci95.upper, fitted_estimate(tally_of(hits), 1.0).excluded_volume);
}

TEST(FittedEstimate, WithoutHitsOrMissesClaimsNoErrorOfZero) {
  for (const bool hits : {false, true}) {
    const VolumeEstimate found = fitted_estimate(tally_of(std::vector<Trial>(1000, {0.25, hit_if(hits)})), 8.0);
    EXPECT_EQ(found.excluded_volume, hits ? 2.0 : 0.0);
    EXPECT_NEAR(found.std_error, 2.0 * 0.5 / 1001, 1e-9) << "Wilson's half-width at z = 1, of the mean volume";
    EXPECT_GE(found.ci95.lower, 0.0);
    EXPECT_GT(found.ci95.upper, found.excluded_volume);
  }
  EXPECT_TRUE(
      std::isinf(fitted_estimate(tally_of(std::vector<Trial>{{0.5, Outcome::disjoint}}), 1.0).relative_error()));
  // All hit, of different shares: the shares' own scatter and what unseen misses may add.
  std::vector<Trial> trials;
  std::vector<double> numbers;
  for (int k = 0; k < 1000; ++k) {
    numbers.push_back(k % 2 == 0 ? 0.25 : 0.75);
    trials.push_back({numbers.back(), Outcome::overlap});
  }
  EXPECT_NEAR(fitted_estimate(tally_of(trials), 1.0).std_error, std::hypot(direct(numbers).std_error, 0.5 * 0.5 / 1001),
              1e-12);
  // All undecided: anything between nothing and everything.
  const VolumeEstimate nothing = fitted_estimate(tally_of(std::vector<Trial>(100, {0.5, Outcome::undecided})), 1.0);
  EXPECT_EQ(nothing.excluded_volume, 0.25);
  EXPECT_GE(nothing.std_error, 0.25);
  EXPECT_EQ(nothing.ci95.lower, 0.0);
  EXPECT_GE(nothing.ci95.upper, 0.5);
}

TEST(FittedEstimate, OfSharesOfOneIsHitOrMisss) {
  std::mt19937_64 random(4);
  for (const double p : {0.02, 0.5, 0.9}) {
    std::vector<Trial> trials;
    for (int k = 0; k < 3000; ++k) trials.push_back({1.0, hit_if(in_unit_interval(random) < p)});
    const Tally tally = tally_of(trials);
    const VolumeEstimate fitted = fitted_estimate(tally, 5.0), constant = hit_or_miss_estimate(tally, 5.0);
    EXPECT_DOUBLE_EQ(fitted.excluded_volume, constant.excluded_volume);
    EXPECT_NEAR(fitted.std_error, constant.std_error * std::sqrt(3000.0 / 2999.0), 1e-12);
  }
}

TEST(FittedEstimate, HoldsTheTruthNinetyFivePercentOfTheTimeAndABiasedOneDoesNot) {
  // Shares s uniform on [0, 1], hits with probability s: the truth is E s^2 = 1/3.
  const auto fraction_held = [](double bias) {
    std::mt19937_64 random(5);
    constexpr int runs = 2000, n = 1000;
    int held = 0;
    for (int run = 0; run < runs; ++run) {
      Tally tally;
      for (int k = 0; k < n; ++k) {
        const double share = in_unit_interval(random);
        tally.add(verdict_of(hit_if(in_unit_interval(random) < (1.0 + bias) * share)), share);
      }
      const VolumeEstimate found = fitted_estimate(tally, 3.0);
      held += found.ci95.lower <= 1.0 && 1.0 <= found.ci95.upper ? 1 : 0;
    }
    return std::fabs(static_cast<double>(held) / runs - 0.95) / std::sqrt(0.95 * 0.05 / runs);
  };
  EXPECT_LE(fraction_held(0.0), 4.5);
  EXPECT_GT(fraction_held(-0.03), 4.5) << "less than a standard error of bias";
}

TEST(VolumeEstimate, IsTheOneOfTheDomain) {
  const Tally tally = tally_of({{0.25, Outcome::overlap}, {0.75, Outcome::disjoint}, {0.5, Outcome::overlap}});
  Domain domain;
  domain.volume = 12.0;
  domain.kind = Domain::Kind::fitted;
  EXPECT_DOUBLE_EQ(volume_estimate(tally, domain).excluded_volume, 12.0 * 0.75 / 3.0);
  EXPECT_DOUBLE_EQ(mean_sampling_volume(tally, domain), 12.0 * 0.5);
  EXPECT_EQ(mean_sampling_volume({}, domain), 12.0) << "before the first trial";
  for (const Domain::Kind kind : {Domain::Kind::ball, Domain::Kind::box}) {
    domain.kind = kind;
    EXPECT_DOUBLE_EQ(volume_estimate(tally, domain).excluded_volume, 12.0 * 2.0 / 3.0);
    EXPECT_EQ(mean_sampling_volume(tally, domain), 12.0);
  }
}

TEST(ExcessOverOther, IsTheMeanOfTheDifferences) {
  std::mt19937_64 random(6);
  Domain domain;
  domain.kind = Domain::Kind::fitted;
  domain.volume = 6.0;
  Tally tally;
  Comparison comparison;
  std::vector<double> differences;
  for (int k = 0; k < 5000; ++k) {
    const double share = in_unit_interval(random), roll = in_unit_interval(random);
    const bool run = roll < 0.5, other = roll < 0.45 || roll > 0.98;
    tally.add(verdict_of(hit_if(run)), share);
    comparison.add(verdict_of(hit_if(run)), verdict_of(hit_if(other)), share);
    differences.push_back(6.0 * share * ((run ? 1.0 : 0.0) - (other ? 1.0 : 0.0)));
  }
  const VolumeEstimate found = excess_over_other(tally, comparison, domain);
  const Direct expected = direct(differences);
  EXPECT_GT(expected.mean, 4.0 * expected.std_error);
  EXPECT_NEAR(found.excluded_volume, expected.mean, 1e-12);
  EXPECT_NEAR(found.std_error, expected.std_error, 1e-12);
  EXPECT_NEAR(found.ci95.upper - found.ci95.lower, 2.0 * 1.959963984540054 * expected.std_error, 1e-12);
}

TEST(ExcessOverOther, WithoutDisputesClaimsNoErrorOfZeroAndCountsWhatWasNotCompared) {
  Domain domain;
  domain.kind = Domain::Kind::fitted;
  domain.volume = 6.0;
  const Verdict hit = verdict_of(Outcome::overlap), unsure = verdict_of(Outcome::undecided);
  Tally tally;
  Comparison agreed, partly;
  for (int k = 0; k < 1000; ++k) {
    tally.add(hit, 0.5);
    agreed.add(hit, hit, 0.5);
    partly.add(hit, k < 10 ? unsure : hit, 0.5);
  }
  EXPECT_EQ(excess_over_other(tally, agreed, domain).excluded_volume, 0.0);
  const double unseen = 6.0 * 0.5 * 0.5 / 1001;
  EXPECT_NEAR(excess_over_other(tally, agreed, domain).std_error, unseen, 1e-9);
  EXPECT_EQ(partly.n_undecided, 10u);
  EXPECT_EQ(partly.n_compared, 990u);
  EXPECT_NEAR(excess_over_other(tally, partly, domain).std_error, std::hypot(unseen, 6.0 * 0.01), 1e-9);
}

TEST(Comparison, CountsWhoAloneHit) {
  const Verdict hit = verdict_of(Outcome::overlap), miss = verdict_of(Outcome::disjoint);
  const Verdict unsure = verdict_of(Outcome::undecided);
  Comparison all;
  for (const auto& [run, other, share] : std::vector<std::tuple<Verdict, Verdict, double>>{{hit, miss, 0.5},
                                                                                           {hit, miss, 0.25},
                                                                                           {miss, hit, 0.125},
                                                                                           {hit, hit, 1.0},
                                                                                           {miss, miss, 1.0},
                                                                                           {unsure, hit, 1.0},
                                                                                           {hit, unsure, 1.0},
                                                                                           {unsure, unsure, 1.0}}) {
    Comparison one;
    one.add(run, other, share);
    all += one;
  }
  EXPECT_EQ(all.n_undecided, 2u);
  EXPECT_EQ(all.n_compared, 5u);
  EXPECT_EQ(all.n_only_run, 2u);
  EXPECT_EQ(all.n_only_other, 1u);
  EXPECT_EQ(all.only_run.first.value(), 0.75);
  EXPECT_EQ(all.only_run.second.value(), 0.3125);
  EXPECT_EQ(all.only_other.first.value(), 0.125);
  EXPECT_EQ(all.only_other.second.value(), 0.015625);
}

}  // namespace
}  // namespace vex

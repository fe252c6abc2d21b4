// The error of values in classes: by hand, and what keeps it honest.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/sampling/estimate.h"
#include "engine/sampling/stop_rule.h"

namespace vex {
namespace {

// Classes of these values each.
Tally tally_of(ClassTally::Kind kind, const std::vector<std::vector<double>>& classes, double unit = 1.0) {
  Tally tally;
  tally.by_class.kind = kind;
  tally.by_class.unit = unit;
  for (const std::vector<double>& values : classes) {
    ClassSums sums;
    sums.n = values.size();
    sums.values.add(std::span<const double>(values));
    tally.n_trials += values.size();
    tally.by_class.classes.push_back(sums);
  }
  return tally;
}

TEST(ClassEstimate, OfIndependentTrialsIsTheSampleMean) {
  const VolumeEstimate estimate = class_estimate(tally_of(ClassTally::Kind::one, {{0.1, 0.2, 0.6, 0.7}}, 3.0));
  EXPECT_NEAR(estimate.excluded_volume, 1.2, 1e-14);
  const double variance = (0.09 + 0.04 + 0.04 + 0.09) / 3.0 * 9.0;
  EXPECT_NEAR(estimate.std_error, std::sqrt(variance / 4.0), 1e-14);
  EXPECT_NEAR(estimate.ci95.upper - estimate.excluded_volume, 3.18244630528 * estimate.std_error, 1e-9)
      << "Student's t of three degrees of freedom";
}

TEST(ClassEstimate, OfScramblingsIsOfTheirMeansAlone) {
  // Means .1, .2, .6: what varies within a class counts nothing.
  const VolumeEstimate estimate =
      class_estimate(tally_of(ClassTally::Kind::scramblings, {{0.0, 0.2}, {0.1, 0.3}, {0.2, 1.0}}, 2.0));
  EXPECT_NEAR(estimate.excluded_volume, 0.6, 1e-15);
  EXPECT_NEAR(estimate.std_error, 2.0 * std::sqrt((0.04 + 0.01 + 0.09) / 6.0), 1e-14);
  EXPECT_NEAR(estimate.ci95.upper - estimate.excluded_volume, 4.30265272975 * estimate.std_error, 1e-10)
      << "Student's t of two degrees of freedom";
}

TEST(ClassEstimate, OfStrataIsTheMeanOfTheirsWhateverTheirNumbers) {
  const VolumeEstimate estimate =
      class_estimate(tally_of(ClassTally::Kind::strata, {{0.1, 0.3}, {0.5, 0.7, 0.9, 0.7}}));
  EXPECT_NEAR(estimate.excluded_volume, 0.45, 1e-15);
  const double first = 0.02 / 2.0, second = (0.04 + 0.04) / 3.0 / 4.0;
  EXPECT_NEAR(estimate.std_error, 0.5 * std::sqrt(first + second), 1e-14);
}

TEST(ClassEstimate, WhereAClassIsEmptyOrOneValueIsAllThereIsNoError) {
  using Kind = ClassTally::Kind;
  for (const Kind kind : {Kind::scramblings, Kind::strata}) {
    EXPECT_TRUE(std::isinf(class_estimate(tally_of(kind, {{0.5, 0.6}, {0.7}, {}})).std_error));
    EXPECT_TRUE(std::isfinite(class_estimate(tally_of(kind, {{0.5, 0.6}, {0.7}})).std_error));
  }
  EXPECT_TRUE(std::isinf(class_estimate(tally_of(Kind::one, {{0.5}})).std_error));
}

TEST(ClassEstimate, OfHitsAloneInAStratumExpectsMisses) {
  const std::vector<double> hits(100, 1.0), misses(100, 0.0);
  const VolumeEstimate estimate = class_estimate(tally_of(ClassTally::Kind::strata, {hits, misses}));
  EXPECT_EQ(estimate.excluded_volume, 0.5);
  EXPECT_GT(estimate.std_error, 0.5 * 0.5 / 101.0);
}

TEST(ClassEstimate, IsNeverBelowTheRounding) {
  Tally tally = tally_of(ClassTally::Kind::scramblings, {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}});
  tally.by_class.relative_rounding = 1e-8;
  EXPECT_EQ(class_estimate(tally).std_error, 0.5e-8);
  EXPECT_LT(class_estimate(tally).ci95.lower, 0.5);
}

TEST(ClassEstimate, CountsWhatUndecidedValuesLieBetween) {
  Tally tally = tally_of(ClassTally::Kind::scramblings, {{0.5, 0.5}, {0.5, 0.5}});
  tally.n_undecided = 2;
  tally.by_class.half_widths.add(0.2);
  EXPECT_NEAR(class_estimate(tally).std_error, 0.05, 1e-14);
  EXPECT_NEAR(class_estimate(tally).ci95.upper, 0.55, 1e-14);
  EXPECT_NEAR(half_width_of_undecided(tally), 0.05, 1e-15);
  // Undecided trials of hit or miss are half a hit each, within half of one.
  Tally hits = tally_of(ClassTally::Kind::scramblings, {{1.0, 0.0}, {0.0, 1.0}});
  for (ClassSums& sums : hits.by_class.classes) {
    sums.n = 4;
    sums.undecided.add(1.0);
  }
  hits.n_trials = 8;
  hits.n_undecided = 2;
  EXPECT_NEAR(class_estimate(hits).excluded_volume, 3.0 / 8.0, 1e-15);
  EXPECT_NEAR(half_width_of_undecided(hits), 1.0 / 8.0, 1e-15);
}

TEST(ClassEstimate, AddsUpFromParts) {
  const std::vector<std::vector<double>> all = {{0.1, 0.4}, {0.2, 0.3}}, first = {{0.1}, {0.2}},
                                         second = {{0.4}, {0.3}};
  Tally sum = tally_of(ClassTally::Kind::scramblings, first);
  sum += tally_of(ClassTally::Kind::scramblings, second);
  EXPECT_EQ(sum, tally_of(ClassTally::Kind::scramblings, all));
  Tally empty;
  empty += sum;
  EXPECT_EQ(empty, sum);
}

TEST(StopRule, LooksAtNetsOfPowersOfTwo) {
  std::uint64_t n = 0;
  for (int k = 0; k < 20; ++k) {
    n = next_evaluation(n, Sequence::sobol);
    EXPECT_EQ(n, kClasses * 64u << k);
  }
}

}  // namespace
}  // namespace vex

#include "engine/sampling/stop_rule.h"

#include <gtest/gtest.h>

namespace vex {
namespace {

Tally tally_with(std::uint64_t trials, std::uint64_t hits) {
  Tally tally;
  tally.n_trials = trials;
  tally.n_hits = hits;
  return tally;
}

const Domain kUnit{Domain::Kind::box, {}, 0.0, {}, 1.0};

TEST(StopRule, EvaluationsAreAFixedGrowingSequence) {
  std::uint64_t n = 0;
  for (int k = 0; k < 400; ++k) {
    const std::uint64_t next = next_evaluation(n);
    ASSERT_GT(next, n);
    ASSERT_EQ(next % 4096, 0u);
    ASSERT_LE(next - n, std::max<std::uint64_t>(4096, n / 16));
    n = next;
  }
  EXPECT_GT(n, 1000000000u) << "few evaluations reach far";
}

TEST(StopRule, WaitsForAHundredHitsAndAHundredMisses) {
  EXPECT_FALSE(reaches(0.5, tally_with(100000, 99), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_with(100000, 100), kUnit, false));
  EXPECT_FALSE(reaches(0.5, tally_with(100000, 100000 - 99), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_with(100000, 100000 - 100), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_with(100000, 100000), kUnit, true)) << "where no miss can come, none is waited for";
}

TEST(StopRule, ComparesTheRelativeError) {
  // p = 1/2: relative error 1 / sqrt(n).
  EXPECT_TRUE(reaches(1.001e-2, tally_with(10000, 5000), kUnit, false));
  EXPECT_FALSE(reaches(0.999e-2, tally_with(10000, 5000), kUnit, false));
}

// Of a fitted domain whose trials all have the share 1/2.
Tally fitted_tally(std::uint64_t trials, std::uint64_t hits, std::uint64_t undecided = 0) {
  Tally tally;
  for (std::uint64_t k = 0; k < trials; ++k) {
    const Verdict verdict = k < hits               ? Verdict::overlap(DecidedBy::gjk)
                            : k < hits + undecided ? Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding)
                                                   : Verdict::disjoint(DecidedBy::gjk);
    tally.add(verdict, 0.5);
  }
  return tally;
}

const Domain kFitted{Domain::Kind::fitted, {}, 0.0, {}, 3.0};

TEST(StopRule, AFittedDomainMayLackMissesAfterManyTrials) {
  constexpr std::uint64_t many = kFittedTrialsWithoutMisses;
  EXPECT_FALSE(reaches(0.5, fitted_tally(100000, 100000 - 99), kFitted, false));
  EXPECT_TRUE(reaches(0.5, fitted_tally(100000, 100000 - 100), kFitted, false));
  EXPECT_FALSE(reaches(0.5, fitted_tally(many - 1, many - 1), kFitted, false));
  EXPECT_TRUE(reaches(0.5, fitted_tally(many, many), kFitted, false));
  EXPECT_TRUE(reaches(0.5, fitted_tally(many, many - 50), kFitted, false));
  EXPECT_FALSE(reaches(0.5, tally_with(many, many), kUnit, false)) << "a constant domain may not";
  EXPECT_FALSE(reaches(0.5, fitted_tally(many, 99), kFitted, false)) << "hits are always waited for";
  EXPECT_TRUE(reaches(0.5, fitted_tally(1000, 1000), kFitted, true)) << "where no miss can come, none is waited for";
}

TEST(StopRule, WithoutMissesTheErrorIsWhatUnseenOnesMayAdd) {
  constexpr std::uint64_t many = kFittedTrialsWithoutMisses;
  const double allowance = 0.5 / (static_cast<double>(many) + 1.0);
  EXPECT_TRUE(reaches(1.01 * allowance, fitted_tally(many, many), kFitted, false));
  EXPECT_FALSE(reaches(0.99 * allowance, fitted_tally(many, many), kFitted, false));
}

TEST(StopRule, UndecidedTrialsOfAFittedDomainKeepAnErrorOutOfReach) {
  // A fifth of what does not miss is undecided: the relative error stays above 0.1 / 0.9 but for chance.
  const Tally tally = fitted_tally(50000, 16000, 4000);
  EXPECT_TRUE(is_out_of_reach(0.05, tally, kFitted));
  EXPECT_FALSE(is_out_of_reach(0.2, tally, kFitted));
  EXPECT_FALSE(is_out_of_reach(1e-9, fitted_tally(50000, 20000), kFitted));
  // Undecided only where the sets are small: what they can change is small as well.
  Tally small = fitted_tally(50000, 16000);
  for (int k = 0; k < 4000; ++k) small.add(Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding), 1e-4);
  EXPECT_FALSE(is_out_of_reach(0.05, small, kFitted));
  EXPECT_TRUE(is_out_of_reach(1e-5, small, kFitted));
}

}  // namespace
}  // namespace vex

#include "engine/sampling/stop_rule.h"

#include <gtest/gtest.h>

namespace vex {
namespace {

Tally tally_of(std::uint64_t trials, std::uint64_t hits) {
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
  EXPECT_FALSE(reaches(0.5, tally_of(100000, 99), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_of(100000, 100), kUnit, false));
  EXPECT_FALSE(reaches(0.5, tally_of(100000, 100000 - 99), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_of(100000, 100000 - 100), kUnit, false));
  EXPECT_TRUE(reaches(0.5, tally_of(100000, 100000), kUnit, true)) << "where no miss can come, none is waited for";
}

TEST(StopRule, ComparesTheRelativeError) {
  // p = 1/2: relative error 1 / sqrt(n).
  EXPECT_TRUE(reaches(1.001e-2, tally_of(10000, 5000), kUnit, false));
  EXPECT_FALSE(reaches(0.999e-2, tally_of(10000, 5000), kUnit, false));
}

}  // namespace
}  // namespace vex

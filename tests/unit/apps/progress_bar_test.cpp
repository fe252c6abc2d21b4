#include "apps/common/progress_bar.h"

#include <gtest/gtest.h>

namespace vex {
namespace {

Progress progress_of(std::uint64_t trials, std::uint64_t hits, double seconds, const StopRule& stop) {
  Progress progress;
  progress.stop = stop;
  progress.tally.n_trials = trials;
  progress.tally.n_hits = hits;
  progress.relative_error = hit_or_miss_estimate(progress.tally, 1.0).relative_error();
  progress.seconds = seconds;
  return progress;
}

TEST(FractionDone, IsTheLargestShareOfAnyStopRule) {
  StopRule stop;
  stop.trials = 1000;
  EXPECT_DOUBLE_EQ(fraction_done(progress_of(250, 100, 1.0, stop)), 0.25);
  stop.seconds = 2.0;
  EXPECT_DOUBLE_EQ(fraction_done(progress_of(250, 100, 1.0, stop)), 0.5);
  EXPECT_DOUBLE_EQ(fraction_done(progress_of(250, 100, 5.0, stop)), 1.0);
}

TEST(FractionDone, OfARelativeErrorGrowsWithTheTrials) {
  StopRule stop;
  stop.relative_error = 1e-2;
  // p = 1/2: 10^4 trials are needed.
  EXPECT_NEAR(fraction_done(progress_of(2500, 1250, 1.0, stop)), 0.25, 1e-12);
  EXPECT_NEAR(fraction_done(progress_of(10000, 5000, 1.0, stop)), 1.0, 1e-12);
  EXPECT_LT(fraction_done(progress_of(10000, 9990, 1.0, stop)), 0.2) << "ten misses of the hundred";
  EXPECT_LT(fraction_done(progress_of(10000, 0, 1.0, stop)), 0.01);
}

}  // namespace
}  // namespace vex

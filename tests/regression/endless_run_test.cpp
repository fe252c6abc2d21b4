// Runs that asked for a relative error and never ended. Of near-balls in the ball of their radii one trial in 10^7
// missed, and 100 misses were waited for. And where most trials are undecided (a needle and a ball 10^-8 of its
// length), half of their share is part of the error, which then stays above any that is asked for.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {
namespace {

RunRecord run_to_a_thousandth(const Body& a, const Body& b, MonteCarloSettings settings) {
  settings.stop.relative_error = 1e-3;
  settings.stop.max_trials = 100'000'000;  // so that a failure ends too
  return run_monte_carlo(a.body, b.body, settings);
}

const Domain kUnit{Domain::Kind::box, {}, 0.0, {}, 1.0};

TEST(EndlessRun, OfNearBallsEndsInTheBox) {
  for (const char* text : {"ellipsoid:1,1,1.0000001", "rounded:1e9,box:1,1,1", "rounded:1e6,needle:1"}) {
    const Body body = parse_shape(text);
    MonteCarloSettings settings;
    settings.domain = best_domain(body.body, body.body);
    const RunRecord record = run_to_a_thousandth(body, body, settings);
    EXPECT_EQ(record.stopped_by, StopReason::relative_error) << text;
    const VolumeEstimate found = hit_or_miss_estimate(record.tally, settings.domain.volume);
    const double truth = average_excluded_volume(body.measures, body.measures);
    EXPECT_LE(std::fabs(found.excluded_volume - truth), 4.0 * found.std_error) << text;
  }
  const Body sphere = parse_shape("rounded:0.5,sphere:1");
  EXPECT_EQ(best_domain(sphere.body, sphere.body).kind, Domain::Kind::ball) << "a ball, to rounding: every trial hits";
}

TEST(EndlessRun, WhereUndecidedTrialsAreTheErrorIsGivenUp) {
  const Body needle = parse_shape("needle:1"), dot = parse_shape("sphere:1e-9");
  MonteCarloSettings settings;
  settings.domain = best_domain(needle.body, dot.body);
  const RunRecord record = run_to_a_thousandth(needle, dot, settings);
  if (record.tally.n_undecided > record.tally.n_trials / 100) {
    EXPECT_EQ(record.stopped_by, StopReason::undecided);
    EXPECT_FALSE(record.complete);
  } else {
    EXPECT_EQ(record.stopped_by, StopReason::relative_error) << "better: the engine decides them by now";
  }
  settings.stop.trials = 100'000;
  EXPECT_EQ(run_to_a_thousandth(needle, dot, settings).tally.n_trials, 100'000u) << "another rule ends it as asked";
}

TEST(EndlessRun, IsSureBeforeItGivesUp) {
  Tally tally;
  tally.n_trials = 4096;
  tally.n_hits = 2048;
  tally.n_undecided = 3;
  EXPECT_FALSE(is_out_of_reach(1e-4, tally, kUnit)) << "three may be chance";
  tally.n_undecided = 400;
  EXPECT_TRUE(is_out_of_reach(1e-3, tally, kUnit));
  EXPECT_FALSE(is_out_of_reach(0.2, tally, kUnit)) << "half of a tenth, of a half";
  tally.n_undecided = 0;
  EXPECT_FALSE(is_out_of_reach(1e-12, tally, kUnit));
}

}  // namespace
}  // namespace vex

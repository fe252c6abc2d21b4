// What an estimator costs for a pair of bodies: variance times time, from a short run. The variance is the run's; the
// time is counted (trial_cost.h), for what is chosen by a clock is another thing on another day.
#pragma once

#include <cstdint>

#include "engine/sampling/monte_carlo.h"

namespace vex {

struct PilotCost {
  std::uint64_t n_trials = 0;
  double seconds_per_trial = 0.0;       // on one thread, about: counted
  double seconds_per_trial_here = 0.0;  // measured, for telling how long a run will take; nothing is chosen by it
  double relative_error = 0.0;          // after n_trials; infinite where it says nothing
  double slope = -0.5;  // of log error over log trials: of random points -1/2, of others from two lengths

  /// To a standard error relative to the estimate; infinite where the pilot found none.
  double trials_to(double relative_error) const;
  /// On one thread, to a standard error relative to the estimate; infinite where the pilot found none.
  double seconds_to(double relative_error) const;
  double relative_error_after(double seconds) const;
};

/// Runs the settings on one thread with stop rules of its own: 256 trials, and eight and sixty-four times as many as
/// long as those before cost no more than `most_seconds`, by the count; of a run of fewer than 256 trials no more. A
/// function of the bodies and the settings, the same for any number of threads, every time. The numbers are not the
/// run's: the seed is another one, so that a choice that is made by them leaves the run unbiased.
PilotCost pilot(const ConvexBody& a, const ConvexBody& b, MonteCarloSettings settings, double most_seconds = 1e-3);

}  // namespace vex

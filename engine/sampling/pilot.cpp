#include "engine/sampling/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/sampling/trial_cost.h"

namespace vex {
namespace {

constexpr std::uint64_t kOtherSeed = 0x9e3779b97f4a7c15u;

struct Length {
  std::uint64_t n_trials;
  double seconds_per_trial;
  double relative_error = std::numeric_limits<double>::infinity();
};

Length run(const ConvexBody& a, const ConvexBody& b, MonteCarloSettings& settings, std::uint64_t n_trials) {
  settings.stop = {};
  settings.stop.trials = n_trials;
  const RunRecord record = run_monte_carlo(a, b, settings);
  Length length{record.tally.n_trials, record.seconds / static_cast<double>(std::max(n_trials, record.tally.n_trials))};
  if (length.n_trials > 0) {
    const VolumeEstimate estimate = volume_estimate(record.tally, settings.domain);
    constexpr double kSaysNothing = 0.5;
    const double error = estimate.relative_error();
    if (estimate.excluded_volume > 0.0 && error < kSaysNothing) length.relative_error = error;
  }
  return length;
}

}  // namespace

double PilotCost::relative_error_after(double seconds) const {
  return relative_error * std::pow(seconds / (seconds_per_trial * static_cast<double>(n_trials)), slope);
}

double PilotCost::trials_to(double wanted) const {
  if (!(relative_error < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::infinity();
  constexpr double kLeast = 2048.0;  // no run is shorter than one evaluation
  return std::max(kLeast, static_cast<double>(n_trials) * std::pow(wanted / relative_error, 1.0 / slope));
}

double PilotCost::seconds_to(double wanted) const {
  constexpr double kSetUp = 1e-4;
  return kSetUp + seconds_per_trial * trials_to(wanted);
}

PilotCost pilot(const ConvexBody& a, const ConvexBody& b, MonteCarloSettings settings, double most_seconds) {
  constexpr std::uint64_t kLeast = 8 * kClasses, kMost = 512 * kClasses;
  constexpr std::uint64_t kApart = 8;  // lengths, whose errors tell the slope
  // Of a run that is shorter than the shortest pilot longer ones would take more than all of the run.
  const bool is_short = settings.stop.trials && *settings.stop.trials < kLeast;
  settings.n_threads = 1;
  settings.seed ^= kOtherSeed;
  settings.on_progress = nullptr;
  settings.on_state = nullptr;
  settings.resume = nullptr;
  settings.ranks = nullptr;
  settings.first_trial = 0;
  settings.cross_check.clear();
  settings.verify = false;
  PilotCost cost;
  cost.seconds_per_trial = 1e-9 * (settings.integrand ? settings.integrand()->cost() : pose_cost(a, b, settings));
  const Length shortest = run(a, b, settings, kLeast);
  Length last = shortest;
  // Where a trial takes long a factor of two in its error is known from the shortest run alone.
  constexpr double kLong = 20.0;
  const auto costs_little = [&](const Length& length) {
    const double most = length.n_trials == kLeast ? kLong * most_seconds : most_seconds;
    return static_cast<double>(length.n_trials) * cost.seconds_per_trial < most;
  };
  while (!is_short && last.n_trials > 0 && last.n_trials < kMost && costs_little(last)) {
    const Length next = run(a, b, settings, kApart * last.n_trials);
    if (next.n_trials <= last.n_trials) break;  // interrupted
    last = next;
  }
  cost.n_trials = last.n_trials;
  cost.seconds_per_trial_here = last.seconds_per_trial;
  cost.relative_error = last.relative_error;
  if (settings.sequence == Sequence::sobol && last.n_trials > shortest.n_trials && last.relative_error > 0.0) {
    const double slope = std::log(last.relative_error / shortest.relative_error) /
                         std::log(static_cast<double>(last.n_trials) / static_cast<double>(shortest.n_trials));
    // Beyond what can be is the noise of short runs. Hits and misses in d dimensions: -1/2 - 1/(2 d) (Z. He, X. Wang,
    // SIAM J. Numer. Anal. 53, 2488, 2015); values with kinks seldom better than -1 over the errors asked for.
    const double steepest = settings.integrand ? -1.0 : -0.5 - 0.5 / (3.0 + settings.law.dimension());
    // Half of what is beyond -1/2: slopes flatten as often as not.
    if (std::isfinite(slope)) cost.slope = 0.5 * (std::clamp(slope, steepest, -0.5) - 0.5);
  }
  return cost;
}

}  // namespace vex

// When a run ends.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/sampling/estimate.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/tally.h"

namespace vex {

/// Whichever comes first. At least one of the first three should be given; `max_trials` ends a run as incomplete.
struct StopRule {
  std::optional<std::uint64_t> trials;
  std::optional<double> relative_error;  // std_error / estimate
  std::optional<double> seconds;
  std::uint64_t max_trials = 100'000'000'000;
};

enum class StopReason {
  trials,          // as many as asked for
  relative_error,  // as small as asked for
  seconds,         // as long as asked for
  max_trials,      // given up: incomplete
  undecided,       // given up: undecided trials alone keep the error above what was asked for: incomplete
  rounding,        // given up: an integrand's own rounding is above it: incomplete
  in_vain,         // given up: after many trials next to nothing is known of the mean (is_in_vain): incomplete
  interrupted,     // by the user: incomplete
};

constexpr std::string_view name_of(StopReason reason) {
  switch (reason) {
    case StopReason::trials: return "trials";
    case StopReason::relative_error: return "rel-error";
    case StopReason::seconds: return "seconds";
    case StopReason::max_trials: return "max-trials";
    case StopReason::undecided: return "undecided";
    case StopReason::rounding: return "rounding";
    case StopReason::in_vain: return "in-vain";
    case StopReason::interrupted: break;
  }
  return "interrupted";
}

/// Hits and misses without which a relative error is not trusted: its own estimate would be too rough.
inline constexpr std::uint64_t kMinHitsAndMisses = 100;

/// Of scrambled points the counts are powers of two times the number of scramblings, where each is a net.
inline constexpr std::uint64_t kFirstSobolEvaluation = kClasses * 64;

/// The trial counts at which the relative error is looked at: a fixed sequence that grows by a sixteenth, so that the
/// end of a run depends on nothing but its hits, and overshoots by at most 6 %.
constexpr std::uint64_t next_evaluation(std::uint64_t n_trials, Sequence sequence = Sequence::random) {
  if (sequence == Sequence::sobol) return n_trials == 0 ? kFirstSobolEvaluation : 2 * n_trials;
  constexpr std::uint64_t kStep = 4096;
  const std::uint64_t growth = n_trials / (16 * kStep) * kStep;
  return n_trials + (growth > kStep ? growth : kStep);
}

/// As many trials of a fitted domain stand for the misses, which it may nearly never have: the allowance for unseen
/// ones is then part of the error (fitted_estimate).
inline constexpr std::uint64_t kFittedTrialsWithoutMisses = 1u << 20;

/// Whether the relative error asked for is reached. `certain`: every trial hits by construction, so no miss is waited
/// for.
inline bool reaches(double relative_error, const Tally& tally, const Domain& domain, bool certain) {
  if (tally.by_class.kind != ClassTally::Kind::none && !tally.by_class.are_hits) {
    return volume_estimate(tally, domain).relative_error() <= relative_error;
  }
  if (tally.n_hits < kMinHitsAndMisses) return false;
  const bool may_lack_misses =
      certain || (domain.kind == Domain::Kind::fitted && tally.n_trials >= kFittedTrialsWithoutMisses);
  if (!may_lack_misses && tally.n_misses() < kMinHitsAndMisses) return false;
  return volume_estimate(tally, domain).relative_error() <= relative_error;
}

/// Whether a run that only a relative error ends is given up: ten million trials leave more than a tenth of the mean
/// open, or all of it, and with an error that falls as the root of their number `most_trials` will not do either. Such
/// are bodies whose A - B is nothing, or next to nothing, of what positions are drawn from.
inline bool is_in_vain(double relative_error, const Tally& tally, const Domain& domain, std::uint64_t most_trials) {
  constexpr std::uint64_t kMany = 10'000'000;
  constexpr double kNextToNothing = 0.1;
  if (tally.n_trials < kMany) return false;
  const double reached = volume_estimate(tally, domain).relative_error(), factor = reached / relative_error;
  return !(reached < kNextToNothing) &&
         !(static_cast<double>(tally.n_trials) * (factor * factor) < static_cast<double>(most_trials));
}

/// Whether undecided trials alone keep the relative error above the one asked for, however many trials follow: half of
/// their share is part of the standard error (hit_or_miss_estimate). Six standard deviations sure.
inline bool is_out_of_reach(double relative_error, const Tally& tally, const Domain& domain) {
  constexpr double kSure = 6.0;
  if (tally.n_undecided == 0) return false;
  if (tally.by_class.kind != ClassTally::Kind::none) {
    // Of a mean which some thousand undecided values tell well enough.
    const VolumeEstimate estimate = volume_estimate(tally, domain);
    const double half_width = half_width_of_undecided(tally);
    const double least = half_width * (1.0 - kSure / std::sqrt(static_cast<double>(tally.n_undecided)));
    return least > relative_error * (std::fabs(estimate.excluded_volume) + kSure * estimate.std_error);
  }
  const std::uint64_t n_not_missed = tally.n_hits + tally.n_undecided;
  // Mean shares of the sampling volume, 1 where it is constant, turn fractions of trials into volumes.
  double of_undecided = 1.0, of_not_missed = 1.0;
  if (domain.kind == Domain::Kind::fitted) {
    const double undecided = tally.undecided.first.value();
    of_undecided = undecided / static_cast<double>(tally.n_undecided);
    of_not_missed = (tally.hits.first.value() + undecided) / static_cast<double>(n_not_missed);
  }
  const double least_undecided = wilson_interval(tally.n_undecided, tally.n_trials, kSure).lower * of_undecided;
  const double most_hits = wilson_interval(n_not_missed, tally.n_trials, kSure).upper * of_not_missed;
  return 0.5 * least_undecided > relative_error * most_hits;
}

}  // namespace vex

// When a run ends.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/sampling/estimate.h"
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
  interrupted,     // by the user: incomplete
};

constexpr std::string_view name_of(StopReason reason) {
  switch (reason) {
    case StopReason::trials: return "trials";
    case StopReason::relative_error: return "rel-error";
    case StopReason::seconds: return "seconds";
    case StopReason::max_trials: return "max-trials";
    case StopReason::undecided: return "undecided";
    case StopReason::interrupted: break;
  }
  return "interrupted";
}

/// Hits and misses without which a relative error is not trusted: its own estimate would be too rough.
inline constexpr std::uint64_t kMinHitsAndMisses = 100;

/// The trial counts at which the relative error is looked at: a fixed sequence that grows by a sixteenth, so that the
/// end of a run depends on nothing but its hits, and overshoots by at most 6 %.
constexpr std::uint64_t next_evaluation(std::uint64_t n_trials) {
  constexpr std::uint64_t kStep = 4096;
  const std::uint64_t growth = n_trials / (16 * kStep) * kStep;
  return n_trials + (growth > kStep ? growth : kStep);
}

/// Whether the relative error asked for is reached. `certain`: every trial hits by construction, so no miss is waited
/// for.
inline bool reaches(double relative_error, const Tally& tally, bool certain) {
  if (tally.n_hits < kMinHitsAndMisses) return false;
  if (!certain && tally.n_misses() < kMinHitsAndMisses) return false;
  return hit_or_miss_estimate(tally, 1.0).relative_error() <= relative_error;
}

/// Whether undecided trials alone keep the relative error above the one asked for, however many trials follow: half of
/// their share is part of the standard error (hit_or_miss_estimate). Six standard deviations sure.
inline bool is_out_of_reach(double relative_error, const Tally& tally) {
  constexpr double kSure = 6.0;
  if (tally.n_undecided == 0) return false;
  const double least_share = wilson_interval(tally.n_undecided, tally.n_trials, kSure).lower;
  const double most_hits = wilson_interval(tally.n_hits + tally.n_undecided, tally.n_trials, kSure).upper;
  return 0.5 * least_share > relative_error * most_hits;
}

}  // namespace vex

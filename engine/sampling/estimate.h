// From counts to the excluded volume and its error.
#pragma once

#include <cstdint>

#include "engine/sampling/domain.h"
#include "engine/sampling/tally.h"

namespace vex {

struct Interval95 {
  double lower = 0.0;
  double upper = 0.0;
};

/// Wilson's interval for k successes of n >= 1 at z standard deviations (E. B. Wilson, JASA 22, 209, 1927).
Interval95 wilson_interval(std::uint64_t n_hits, std::uint64_t n_trials, double z);

/// The excluded volume by hit-or-miss: the domain's volume times the fraction of hits. Units of length^3.
///
/// `std_error` is the binomial one; with no hit or no miss it is the half-width of Wilson's interval at z = 1, so that
/// an error of zero is never claimed. Undecided trials may be hits or misses: the estimate takes the middle, the
/// interval reaches from all of them missing to all of them hitting, and their half-width is part of the error.
struct VolumeEstimate {
  double excluded_volume = 0.0;
  double std_error = 0.0;
  Interval95 ci95;

  double relative_error() const { return std_error / excluded_volume; }  // infinite for no hit
};

VolumeEstimate hit_or_miss_estimate(const Tally& tally, double domain_volume);

}  // namespace vex

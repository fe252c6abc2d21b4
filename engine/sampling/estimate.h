// From counts to the excluded volume and its error.
#pragma once

#include <cstdint>
#include <limits>

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
  bool is_signed = false;  // of a mean that may be below 0 (Integrand::may_be_negative)

  /// Infinite where nothing was hit, or where the mean came out below 0 and is of no sign.
  double relative_error() const {
    if (is_signed && excluded_volume < 0.0) return -std_error / excluded_volume;
    return excluded_volume > 0.0 ? std_error / excluded_volume : std::numeric_limits<double>::infinity();
  }
};

VolumeEstimate hit_or_miss_estimate(const Tally& tally, double domain_volume);

/// The excluded volume by hit-or-miss-fitted: the mean over the trials of the volume that the trial's position was
/// drawn from times 1 for a hit, 1/2 for an undecided trial, 0 for a miss. `std_error` from the sample variance; what
/// undecided trials add to it is as above; of hits or misses that are none or few (25), what Wilson's interval leaves
/// open is added too. The interval is the normal one.
VolumeEstimate fitted_estimate(const Tally& tally, double domain_volume);

/// The excluded volume from values in classes. `std_error` from the sample variance of independent trials; of
/// scramblings that of the classes' means, of strata the sum of the classes' own variances. The interval is Student's
/// of as many degrees of freedom as there are scramblings, or fewer than 1000 independent trials, less one; otherwise
/// the normal one. What undecided values lie
/// between, and hits or misses that have not come yet, add to it as above; rounding is what `std_error` is not below.
/// Where a scrambling or a stratum is without a trial, and of a single trial, the error is infinite.
VolumeEstimate class_estimate(const Tally& tally);

/// Of values in classes: half of what the undecided ones lie between, over the number of all; length^3.
double half_width_of_undecided(const Tally& tally);

/// The one of the three that belongs to the tally and the domain.
VolumeEstimate volume_estimate(const Tally& tally, const Domain& domain);

/// Mean volume of what positions were drawn from: of a ball or a box its own.
double mean_sampling_volume(const Tally& tally, const Domain& domain);

/// By how much the excluded volume that the run's backend gives exceeds that of another one on the same trials, in
/// length^3. Where the run's backend is exact this is the other one's deficit, and <V_ex>, if it is known, minus this
/// is the other one's value with the exact test as a control variate: nothing but the disputed trials adds to its
/// error. Trials that one of them did not decide are part of the error.
VolumeEstimate excess_over_other(const Tally& tally, const Comparison& comparison, const Domain& domain);

}  // namespace vex

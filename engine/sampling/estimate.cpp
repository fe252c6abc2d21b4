#include "engine/sampling/estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"

namespace vex {

Interval95 wilson_interval(std::uint64_t n_hits, std::uint64_t n_trials, double z) {
  VEX_EXPECT(n_trials > 0 && n_hits <= n_trials);
  const double n = static_cast<double>(n_trials);
  const double p = static_cast<double>(n_hits) / n;
  const double z_sq_over_n = z * z / n;
  const double middle = (p + 0.5 * z_sq_over_n) / (1.0 + z_sq_over_n);
  const double half = std::sqrt(p * (1.0 - p) * z_sq_over_n + 0.25 * z_sq_over_n * z_sq_over_n) / (1.0 + z_sq_over_n);
  // At the ends the interval touches 0 or 1 exactly; rounding must not take it past, nor short of the estimate.
  return {n_hits == 0 ? 0.0 : std::max(0.0, middle - half), n_hits == n_trials ? 1.0 : std::min(1.0, middle + half)};
}

VolumeEstimate hit_or_miss_estimate(const Tally& tally, double domain_volume) {
  VEX_EXPECT(tally.n_trials > 0);
  constexpr double kZ95 = 1.959963984540054;
  const double n = static_cast<double>(tally.n_trials);
  const double undecided = static_cast<double>(tally.n_undecided) / n;
  const double p = static_cast<double>(tally.n_hits) / n + 0.5 * undecided;

  double std_error = std::sqrt(p * (1.0 - p) / n);
  if (tally.n_hits == 0 || tally.n_misses() == 0) {
    const Interval95 one_sigma = wilson_interval(tally.n_hits + tally.n_undecided / 2, tally.n_trials, 1.0);
    std_error = std::max(std_error, 0.5 * (one_sigma.upper - one_sigma.lower));
  }
  std_error = std::hypot(std_error, 0.5 * undecided);
  std_error = std::max(std_error, gamma(16) * p);

  const Interval95 low = wilson_interval(tally.n_hits, tally.n_trials, kZ95);
  const Interval95 high = wilson_interval(tally.n_hits + tally.n_undecided, tally.n_trials, kZ95);
  return {domain_volume * p, domain_volume * std_error, {domain_volume * low.lower, domain_volume * high.upper}};
}

}  // namespace vex

#include "engine/sampling/estimate.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"

namespace vex {
namespace {

constexpr double kZ95 = 1.959963984540054;

// Half the width of Wilson's interval at z = 1: what an event that never came, or always, may still be in error by.
double one_sigma_half_width(std::uint64_t n_hits, std::uint64_t n_trials) {
  const Interval95 one_sigma = wilson_interval(n_hits, n_trials, 1.0);
  return 0.5 * (one_sigma.upper - one_sigma.lower);
}

// So few that a variance of values, or of the means of classes, may not know of the next ones.
bool has_few_hits_or_misses(const Tally& tally) {
  constexpr std::uint64_t kFew = 25;
  return tally.n_hits < kFew || tally.n_misses() < kFew;
}

// Standard error of the mean of n numbers of which `first` is the sum and `second` that of their squares, each square
// short of the truth by less than FixedPointSum::kUnit.
double error_of_mean(double first, double second, double n) {
  const double mean = first / n;
  const double variance = std::max(0.0, second / n + FixedPointSum::kUnit - mean * mean);
  return std::sqrt(variance / std::max(1.0, n - 1.0));
}

void require_trials(const Tally& tally) {
  if (tally.n_trials == 0) throw UsageError("there is no estimate without trials - run some");
}

}  // namespace

Interval95 wilson_interval(std::uint64_t n_hits, std::uint64_t n_trials, double z) {
  if (n_trials == 0 || n_hits > n_trials) throw UsageError("no share has an interval without trials - count some");
  const double n = static_cast<double>(n_trials);
  const double p = static_cast<double>(n_hits) / n;
  const double z_sq_over_n = z * z / n;
  const double middle = (p + 0.5 * z_sq_over_n) / (1.0 + z_sq_over_n);
  const double half = std::sqrt(p * (1.0 - p) * z_sq_over_n + 0.25 * z_sq_over_n * z_sq_over_n) / (1.0 + z_sq_over_n);
  // At the ends the interval touches 0 or 1 exactly; rounding must not take it past, nor short of the estimate.
  return {n_hits == 0 ? 0.0 : std::max(0.0, middle - half), n_hits == n_trials ? 1.0 : std::min(1.0, middle + half)};
}

VolumeEstimate hit_or_miss_estimate(const Tally& tally, double domain_volume) {
  require_trials(tally);
  const double n = static_cast<double>(tally.n_trials);
  const double undecided = static_cast<double>(tally.n_undecided) / n;
  const double p = static_cast<double>(tally.n_hits) / n + 0.5 * undecided;

  double std_error = std::sqrt(p * (1.0 - p) / n);
  if (tally.n_hits == 0 || tally.n_misses() == 0) {
    std_error = std::max(std_error, one_sigma_half_width(tally.n_hits + tally.n_undecided / 2, tally.n_trials));
  }
  std_error = std::hypot(std_error, 0.5 * undecided);
  std_error = std::max(std_error, gamma(16) * p);

  const Interval95 low = wilson_interval(tally.n_hits, tally.n_trials, kZ95);
  const Interval95 high = wilson_interval(tally.n_hits + tally.n_undecided, tally.n_trials, kZ95);
  return {domain_volume * p, domain_volume * std_error, {domain_volume * low.lower, domain_volume * high.upper}};
}

VolumeEstimate fitted_estimate(const Tally& tally, double domain_volume) {
  require_trials(tally);
  const double n = static_cast<double>(tally.n_trials);
  const double hits = tally.hits.first.value(), undecided = tally.undecided.first.value();
  const double mean = (hits + 0.5 * undecided) / n;
  double sampling_error =
      error_of_mean(hits + 0.5 * undecided, tally.hits.second.value() + 0.25 * tally.undecided.second.value(), n);
  if (has_few_hits_or_misses(tally)) {
    const double unseen = one_sigma_half_width(tally.n_hits + tally.n_undecided / 2, tally.n_trials);
    sampling_error = std::hypot(sampling_error, tally.all.first.value() / n * unseen);
  }
  double std_error = std::hypot(sampling_error, 0.5 * undecided / n);
  std_error = std::max(std_error, gamma(16) * mean);
  const double lower = std::max(0.0, hits / n - kZ95 * sampling_error);
  const double upper = (hits + undecided) / n + kZ95 * sampling_error;
  return {domain_volume * mean, domain_volume * std_error, {domain_volume * lower, domain_volume * upper}};
}

double half_width_of_undecided(const Tally& tally) {
  double sum = tally.by_class.half_widths.value();
  for (const ClassSums& one : tally.by_class.classes) sum += 0.5 * one.undecided.first.value();
  return tally.by_class.unit * (sum / static_cast<double>(tally.n_trials));
}

VolumeEstimate class_estimate(const Tally& tally) {
  require_trials(tally);
  const ClassTally& by_class = tally.by_class;
  const auto n_classes = static_cast<double>(by_class.classes.size());
  const double n = static_cast<double>(tally.n_trials);
  const auto sum_of = [](const ClassSums& one) { return one.values.first.value() + 0.5 * one.undecided.first.value(); };
  double sum = 0.0, sum_of_means = 0.0, variance = 0.0;
  int n_used = 0;
  for (const ClassSums& one : by_class.classes) {
    if (one.n == 0) continue;
    const double of_class = static_cast<double>(one.n), first = sum_of(one);
    ++n_used;
    sum += first;
    sum_of_means += first / of_class;
    if (by_class.kind == ClassTally::Kind::scramblings) continue;
    double error =
        error_of_mean(first, one.values.second.value() + 0.25 * one.undecided.second.value(), of_class) / n_classes;
    if (by_class.kind == ClassTally::Kind::strata && (first == 0.0 || first == of_class)) {
      // Nothing but misses or hits: others may yet come.
      error = one_sigma_half_width(first == 0.0 ? 0 : one.n, one.n) / n_classes;
    }
    variance += error * error;
  }
  const bool by_strata = by_class.kind == ClassTally::Kind::strata;
  const double mean = by_strata ? sum_of_means / n_used : sum / n;
  double quantile = kZ95;
  constexpr std::uint64_t kFewValues = 1000;
  if (by_class.kind == ClassTally::Kind::one && tally.n_trials > 1 && tally.n_trials < kFewValues) {
    quantile = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  }
  if (by_class.kind == ClassTally::Kind::scramblings && n_used > 1) {
    for (const ClassSums& one : by_class.classes) {
      if (one.n == 0) continue;
      const double off = sum_of(one) / static_cast<double>(one.n) - sum_of_means / n_used;
      variance += off * off / (n_used * (n_used - 1.0));
    }
    quantile = boost::math::quantile(boost::math::students_t(n_used - 1.0), 0.975);
  }
  double sampling_error = std::sqrt(variance);
  // Of two or three means the spread tells next to nothing, and of one value nothing.
  if (n_used < static_cast<int>(by_class.classes.size()) || tally.n_trials < 2) {
    sampling_error = std::numeric_limits<double>::infinity();
  }
  if (by_class.are_hits && !by_strata && has_few_hits_or_misses(tally)) {
    const double shares = tally.all.first.value();  // of a fitted domain
    const double unseen = one_sigma_half_width(tally.n_hits + tally.n_undecided / 2, tally.n_trials);
    sampling_error = std::hypot(sampling_error, (shares > 0.0 ? shares / n : 1.0) * unseen);
  }
  const double half_width = half_width_of_undecided(tally);
  const double volume = by_class.offset + by_class.unit * mean;
  const double rounding = std::max(by_class.rounding_of(volume), gamma(16) * std::fabs(volume));
  const double std_error = std::max(std::hypot(by_class.unit * sampling_error, half_width), rounding);
  const double reach = std::max(by_class.unit * quantile * sampling_error + half_width, rounding);
  // A mean below 0, as a control variate may give one, keeps the interval that is its own.
  const bool ends_at_0 = volume > 0.0 && !by_class.is_signed;
  return {volume,
          std_error,
          {ends_at_0 ? std::max(0.0, volume - reach) : volume - reach, volume + reach},
          by_class.is_signed};
}

VolumeEstimate volume_estimate(const Tally& tally, const Domain& domain) {
  if (tally.by_class.kind != ClassTally::Kind::none) return class_estimate(tally);
  return domain.kind == Domain::Kind::fitted ? fitted_estimate(tally, domain.volume)
                                             : hit_or_miss_estimate(tally, domain.volume);
}

double mean_sampling_volume(const Tally& tally, const Domain& domain) {
  if (domain.kind != Domain::Kind::fitted || tally.n_trials == 0) return domain.volume;
  return domain.volume * (tally.all.first.value() / static_cast<double>(tally.n_trials));
}

VolumeEstimate excess_over_other(const Tally& tally, const Comparison& comparison, const Domain& domain) {
  require_trials(tally);
  const double n = static_cast<double>(tally.n_trials);
  const double sum = comparison.only_run.first.value() - comparison.only_other.first.value();
  const double mean_share = mean_sampling_volume(tally, domain) / domain.volume;
  double std_error = error_of_mean(sum, comparison.only_run.second.value() + comparison.only_other.second.value(), n);
  if (comparison.n_only_run + comparison.n_only_other == 0) {
    std_error = std::hypot(std_error, mean_share * one_sigma_half_width(0, tally.n_trials));
  }
  const double not_compared = static_cast<double>(tally.n_trials - comparison.n_compared) / n;
  std_error = std::hypot(std_error, not_compared);  // a share is at most 1
  const double excess = sum / n;
  return {domain.volume * excess,
          domain.volume * std_error,
          {domain.volume * (excess - kZ95 * std_error), domain.volume * (excess + kZ95 * std_error)}};
}

}  // namespace vex

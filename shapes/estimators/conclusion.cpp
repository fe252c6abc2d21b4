#include <cmath>
#include <limits>
#include <string>

#include "shapes/estimators/excluded_volume.h"
#include "shapes/formula.h"

namespace vex {
namespace {

/// Why the two say nothing of each other; empty where they do.
std::string why_no_comparison(const ExcludedVolume& result, bool hits_by_construction) {
  /// z is in standard errors of the run alone; a reference with half as large an error would make it larger by 12 %.
  constexpr double kComparable = 0.5;
  if (!result.no_run_reason.empty()) return result.no_run_reason;
  if (result.record.tally.n_trials == 0) return "no trial was done";
  if (!result.reference) return result.reference_reason;
  if (!std::isfinite(result.std_error)) return "fewer than 32 trials tell no error";
  if (hits_by_construction) return kHitsByConstruction;
  if (result.std_error <= result.record.tally.by_class.rounding_of(result.value)) {
    return "the values are all the same to rounding";
  }
  if (result.reference->std_error > kComparable * result.std_error) {
    return "the exact average's own error is not small beside the standard error";
  }
  return "";
}

}  // namespace

void conclude(const Measures& a, const Measures& b, bool hits_by_construction, ExcludedVolume* result) {
  VolumeEstimate estimate;
  if (result->record.tally.n_trials > 0) {
    estimate = volume_estimate(result->record.tally, result->domain);
  } else if (result->no_run_reason.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    estimate = {kNone, std::numeric_limits<double>::infinity(), {kNone, kNone}};
  }
  result->value = estimate.excluded_volume;
  result->std_error = estimate.std_error;
  result->ci95 = estimate.ci95;
  result->reduced = reduced_excluded_volume(result->value, a, b);
  result->b2 = second_virial_coefficient(result->value);
  result->z.reset();
  result->z_reason = why_no_comparison(*result, hits_by_construction);
  if (result->z_reason.empty()) result->z = (result->value - result->reference->value) / result->std_error;
}

}  // namespace vex

// From the thresholds of several sizes of the cube to that of infinite space.
//
// The threshold at which R has its universal value differs from the true one by a L^-theta + b L^-theta' with theta =
// 1/nu - y and theta' = 1/nu + 2: 1/nu = 1.1410(15), y = -1.2(2) the leading correction's exponent (J. Wang et al.,
// Phys. Rev. E 87, 052107, 2013), the next one being that of an analytic correction. The three criteria have amplitudes
// a and b of their own, and one threshold. Of spheres b is what the offset is made of up to 6 diameters: without that
// term sizes 4, 6 and 16 gave a threshold four errors of 2e-5 too low, and chi^2 told it but faintly.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/sampling/percolation/threshold.h"

namespace vex {

/// What is known of theta beforehand; the fit has it as a datum beside the thresholds, so that these correct it where
/// they know better, and the criteria that it moves least count most where they do not.
inline constexpr double kSizeExponent = 2.34, kSizeExponentError = 0.2;
inline constexpr double kNextSizeExponent = 3.141;  // theta'
/// b beforehand is 0 to within this part of the threshold, sizes being in extents of a body: of spheres it is 0.4.
inline constexpr double kNextAmplitudeError = 0.5;

/// Thresholds of one size as densities, of whatever the caller counts by.
struct SizedThreshold {
  double size = 0.0;  // L, in extents of the largest body
  std::array<double, kNWrappingCriteria> density{};
  std::array<std::array<double, kNWrappingCriteria>, kNWrappingCriteria> covariance{};
  std::array<double, kNWrappingCriteria> universal_error{};
};
/// lambda / volume.
SizedThreshold sized_threshold(const SizeThreshold& threshold, double size, double volume);

struct Extrapolation {
  double density = 0.0;
  double std_error = 0.0;  // all below, as independent errors
  double scatter_error = 0.0, offset_error = 0.0,
         universal_error = 0.0;  // of realisations; of what is known of theta and b
  double exponent = kSizeExponent, exponent_std_error = kSizeExponentError;  // theta as fitted
  bool is_extrapolated = false;                        // false: one size, and the weighted mean of its criteria is all
  std::array<double, kNWrappingCriteria> amplitude{};  // a, in density times size^theta
  double chi_square = 0.0;                             // of the scatter about the fit
  int degrees_of_freedom = 0;
  double p_value = 1.0;  // of a scatter as large as this
  /// The same without the smallest size, where three or more are there.
  std::optional<double> without_smallest;
};

/// How often chi^2 is as large as this, or larger.
double chi_square_p_value(double chi_square, int degrees_of_freedom);

/// A weighted least-squares fit; the sizes differ. Of isotropic systems (isotropy.h). Throws UsageError.
Extrapolation extrapolate(std::span<const SizedThreshold> sizes);

}  // namespace vex

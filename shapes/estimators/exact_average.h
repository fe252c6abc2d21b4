// The excluded volume at a fixed orientation, exactly, and its mean over any orientation law: the answer to which hit
// or miss is held where the formula for random orientations does not apply.
//
// Mixed volumes, or Legendre polynomials: neither overlap queries nor positions are involved.
#pragma once

#include <atomic>
#include <cstdint>

#include "engine/sampling/poses/orientation_law.h"
#include "shapes/any_shape.h"

namespace vex {

/// In length^3. `error` is one standard error, plus a bound on rounding; infinite where a run was interrupted before
/// there was any.
struct ExactAverage {
  double excluded_volume = 0.0;
  double error = 0.0;
};

struct ExactAverageSettings {
  std::uint64_t seed = 1;
  int n_randomisations = 32;  // from 2 up
  /// A randomisation has at most 2 to this power of points, from 0 to SobolPoints::kBits; fewer where these
  /// would cost more than `largest_cost`.
  int log2_n_points = 15;
  /// Of all randomisations together, in about nanoseconds on one core. It is counted from the numbers of vertices and
  /// faces, not measured: the same bodies give the same result everywhere.
  double largest_cost = 5e8;
  /// Take the series of legendre_average.h, or the quadrature of axial_average.h, where it is good to 1e-6: no random
  /// points then.
  bool series = true;
  /// Becomes non-zero from outside: the result is then that of the randomisations finished so far.
  const std::atomic<int>* interrupt = nullptr;
};

/// The mean of V_ex(R) over the law.
///
/// For the laws of axes and most bodies it is a series (legendre_average.h), its error a bound. For the law angle and
/// two bodies of revolution it is a quadrature (axial_average.h), its error what that says of itself.
/// Otherwise: randomised quasi-Monte Carlo, scrambled Sobol' points (engine/sampling/points/sobol.h), of the estimator
/// that sums mixed volumes (shapes/estimators/mixed_volume_estimator.h). The error is the standard error of the mean
/// over the independent randomisations, and a bound on rounding. Where nothing is random (one orientation; flat faces
/// or two ellipsoids) it is one sum, and the error its rounding bound alone. Throws UsageError where a body comes
/// without its measures on normals, or the settings are out of their ranges.
ExactAverage exact_average(const Body& a, const Body& b, const OrientationLaw& law,
                           const ExactAverageSettings& settings = {});

}  // namespace vex

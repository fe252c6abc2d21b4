// The excluded volume at a fixed orientation, exactly, and its mean over any orientation law: the answer to which hit
// or miss is held where the formula for random orientations does not apply.
//
// V_ex(R) = |A + (-R B)| = V_A + V_B + integral of h_(-RB) over S_A + integral of h_A over S_(-RB): mixed volumes, with
// the surface area measures of shapes/normal_measure.h (H. Minkowski, Math. Ann. 57, 447, 1903; R. Schneider, Convex
// Bodies: The Brunn-Minkowski Theory, 2nd ed., section 5.1). Neither overlap queries nor positions are involved.
#pragma once

#include <atomic>
#include <cstdint>

#include "engine/sampling/orientation_law.h"
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
  /// Take the series of legendre_average.h where it is good to 1e-6: no random points then.
  bool series = true;
  /// Becomes non-zero from outside: the result is then that of the randomisations finished so far.
  const std::atomic<int>* interrupt = nullptr;
};

/// The mean of V_ex(R) over the law.
///
/// For the laws cone and onsager and most named bodies it is a series (legendre_average.h), its error a bound.
/// Otherwise: randomised quasi-Monte Carlo, scrambled Sobol' points (engine/sampling/sobol.h) over the law's
/// coordinates and, for each body, up to two for a normal on a curved part and one that picks a face and an edge where
/// there are more than 64 of either (those of a mesh, in the order of a Hilbert curve over the sphere, so that
/// neighbours of the coordinate are neighbours on the sphere). Half of the picks go by area, half by area times
/// a typical height: the rim of a thin body has next to no area but may have most of the integral. The error is the
/// standard error of the mean over the independent randomisations. Where nothing is random (one orientation; flat faces
/// or two ellipsoids; not more than `largest_cost`) it is one sum, and the error its rounding bound alone.
///
/// What a law or a body makes superfluous is not drawn: over uniform rotations every normal of a body has the same
/// mean; laws that spin each body about its z axis do what the angle about z of a ring's or a rim's normal would do;
/// the integral of h over the uniform normals of a ball part is M of the other body; two ellipsoids have a closed form
/// at each orientation.
///
/// The rounding bound: gamma(256 + number of faces) and 1e-12 relative (what meshes promise of V and S, far above what
/// a rotation's entries are off by), and the bodies' support errors times the other's surface area. Throws UsageError
/// where a body comes without its measures on normals.
ExactAverage exact_average(const MeasuredBody& a, const MeasuredBody& b, const OrientationLaw& law,
                           const ExactAverageSettings& settings = {});

}  // namespace vex

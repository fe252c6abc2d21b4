// The excluded volume of two bodies of revolution at an angle between their axes, by quadrature.
//
// V_ex(gamma) = V_A + V_B + integral of h_(-RB) over S_A + integral of h_A over S_(-RB), as
// mixed_volume_estimator.h has it. Of bodies that are alike about their z axes nothing hangs on their spins: what is
// left of either integral are the polar angle of the normal, of which most measures have a single value, and its
// azimuth.
#pragma once

#include <optional>

#include "engine/sampling/poses/orientation_law.h"
#include "shapes/estimators/legendre_average.h"

namespace vex {

/// Nothing where the law is no `angle`, or where a body is not alike about its z axis: that is what its two measures on
/// normals tell, of which rings, zones, rims, faces across the axis and spheroids are. UsageError where a body has
/// none. The error is what the quadrature (Gauss and Kronrod, adaptive) says of itself and a bound on rounding; of
/// cylinders, cones and capsules some 1e-12 of the value.
std::optional<SeriesAverage> axial_average(const Body& a, const Body& b, const OrientationLaw& law);

}  // namespace vex

// How far a ray from inside the Minkowski difference reaches in it.
#pragma once

#include "engine/numeric/pose.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A point of each body, in its own frame.
struct BodyPoints {
  Vec3d of_a, of_b;
};

/// r(d) of K = A - RB about a point of it, in units of |d|: from where a point of B, turned by R, coincides with one of
/// A, B can be moved by r d before the bodies part.
struct RadialBounds {
  double lower = 0.0, upper = 0.0;
  int n_support_calls = 0;   // of the difference
  bool is_bisected = false;  // the portals stalled, and overlap verdicts were asked for the rest
};

/// Closes in until upper - lower <= relative_gap * upper, or to kRadialRounding (2^-26) of it; the bounds hold in the
/// presence of rounding (E19). R is a rotation to within 2^-40, its translation is not looked at; `dir` is of any
/// length but zero. The points coincide where the bodies overlap by more than rounding: about a point on the surface of
/// K r jumps, and is that of some ray beside this one.
///
/// Where the portals stall, as for a K thinner than 2^-18 of its reach, proven verdicts of `overlap` bisect the rest.
/// Undecided ones widen the bounds. So does what coordinates are rounded by, where the inradii tell how thick K is at
/// least; where they are 0 that may move r by more than the bounds are apart: 8 u of the reaches over the sine of the
/// angle between the ray and the surface.
///
/// Throws InputError where the direction is zero, or it or a point is not finite.
RadialBounds radial_function(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Pose& rotation,
                             const Vec3d& dir, double relative_gap = 0.0);

/// Whether the ray reaches r `dir`: the proven verdict on the bodies placed there.
Outcome outcome_along(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Transformd& rotation,
                      const Vec3d& dir, double r);

}  // namespace vex

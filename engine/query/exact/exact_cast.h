// Linear casts of polytopes, rounded or not, that double precision leaves open.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

struct ExactCast {
  Outcome outcome = Outcome::undecided;
  double lower = 0.0, upper = 0.0;  // of the first contact
  int n_support_calls = 0;
};

/// What bounds leave open where the motion grazes A, or where bodies touch but for rounding or lie in one plane.
///
/// Polytopes are always decided (first_meeting.h). Of rounded ones `overlap` decides without any rounding; at times
/// that have so few digits that every placed coordinate is exact, what it says is true of the motion: a hit, or nothing
/// where there are no such times. The bodies are apart at the start, the first contact is not before `lower`, and there
/// is none after `latest`. Nothing after `until` is looked at: disjoint then means until then.
ExactCast cast_exactly(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                       double lower, double latest, double until);

}  // namespace vex

// Linear casts that touch to within rounding, of polytopes whose coordinates are exact along the way.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

struct ExactCast {
  bool is_hit = false;
  double lower = 0.0, upper = 0.0;  // of the first contact
  int n_support_calls = 0;
};

/// What bounds leave open where the motion grazes A, or is in the plane of two flat bodies. `overlap` decides of
/// polytopes, rounded or not, without any rounding; at times that have so few digits that every placed coordinate is
/// exact, what it says is true of the motion. No hit is found where there are no such times. The first contact is not
/// before `lower`, where the bodies are apart, and there is none after `latest`.
ExactCast cast_exactly(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                       double lower, double latest);

}  // namespace vex

// Do a sphere and a capsule share a point? The distance of a point from a segment against the sum of the radii.
#pragma once

#include "apps/referees/capsule_capsule.h"

namespace vex {

/// The sphere being a capsule without a straight part: C. Ericson, Real-Time Collision Detection, 5.1.2. Either order.
inline Outcome sphere_and_capsule_overlap(double radius, const CapsuleSize& capsule, const Transformd& a_from_b) {
  return capsules_overlap({0.0, radius}, capsule, a_from_b);
}
inline Outcome capsule_and_sphere_overlap(const CapsuleSize& capsule, double radius, const Transformd& a_from_b) {
  return capsules_overlap(capsule, {0.0, radius}, a_from_b);
}

}  // namespace vex

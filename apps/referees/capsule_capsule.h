// Do two capsules share a point? The distance of their axes against the sum of their radii.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"

namespace vex {

/// A capsule about the origin, axis z. A sphere is one whose straight part has no length.
struct CapsuleSize {
  double half_length;  // of the straight part
  double radius;
};

/// Closest points of two segments (V. J. Lumelsky, Inform. Process. Lett. 21, 55 (1985); C. Ericson, Real-Time
/// Collision Detection, 5.1.9), then a proof either way (E10); undecided within rounding of contact.
Outcome capsules_overlap(const CapsuleSize& a, const CapsuleSize& b, const Transformd& a_from_b);

}  // namespace vex

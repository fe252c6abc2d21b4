// Do two spheres share a point?
#pragma once

#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"

namespace vex {

/// Two radii against the centres' distance; undecided within rounding of contact. The distance is within 2.6 u, the sum
/// of the radii within u.
inline Outcome spheres_overlap(double radius_a, double radius_b, const Transformd& a_from_b) {
  const double distance = norm(a_from_b.translation), radii = radius_a + radius_b;
  const double error = 8.0 * kUnitRoundoff * (distance + radii);
  if (distance > radii + error) return Outcome::disjoint;
  return distance < radii - error ? Outcome::overlap : Outcome::undecided;
}

}  // namespace vex

// The unit of time of a motion that turns (docs/derivations.md, E23, "The unit of time"; internal).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/numeric/scaled_bound.h"
#include "engine/numeric/vec3.h"
#include "engine/query/first_contact.h"

namespace vex {

/// The unit of time is 2^-result of the motion's, so that its speeds are neither tiny nor huge beside the bodies.
inline int exponent_of_motion(double size, const RigidMotion& motion, const Vec3d& spin_of_a) {
  // Units of time in which a pair moves by its size, or turns by some radians, in 2^-200 of them, or in 2^200, are as
  // good as others: no square of a time or a speed is subnormal or infinite.
  constexpr int kMostExponent = 200;
  constexpr int kNone = -(1 << 20);  // below every exponent, and no number that has no opposite
  const auto largest_of = [](const Vec3d& v) {
    return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  };
  const double moving = largest_of(motion.velocity);
  const double turning = std::fmax(largest_of(motion.angular_velocity), largest_of(spin_of_a));
  const int exponent = std::max(moving > 0.0 ? std::ilogb(moving) - (size > 0.0 ? std::ilogb(size) : 0) : kNone,
                                turning > 0.0 ? std::ilogb(turning) : kNone);
  if (exponent == kNone) return 0;
  return std::abs(exponent) > kMostExponent ? exponent : 0;
}

inline RigidMotion in_units(const RigidMotion& motion, int exponent) {
  return {times_power_of_two(motion.velocity, -exponent), times_power_of_two(motion.angular_velocity, -exponent)};
}

/// An answer of such units, in the motion's own again.
inline FirstContact in_own_time(FirstContact contact, int exponent) {
  if (exponent == 0) return contact;
  if (contact.verdict.outcome != Outcome::disjoint) contact.lower = scaled_down(contact.lower, -exponent);
  contact.time = contact.verdict.outcome != Outcome::disjoint ? contact.lower : HUGE_VAL;
  contact.upper = scaled_up(contact.upper, -exponent);
  return contact;
}

}  // namespace vex

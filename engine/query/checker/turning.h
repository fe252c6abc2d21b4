// Where a body is that turns while it moves, without rounding: a rotation is irrational, and enclosed.
#pragma once

#include <optional>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/first_contact.h"

namespace vex::checker {

/// B at a time of the motion: x -> exp(t [w]) R x + (T + t v). None where the angle is beyond 2^48 radians.
std::optional<ExactPose> pose_at(const Transformd& a_from_b, const RigidMotion& motion, const whole::Dyadic& time);

whole::DyadicVector cross(const whole::DyadicVector& p, const whole::DyadicVector& q);
inline whole::DyadicVector times(const whole::Dyadic& s, const whole::DyadicVector& v) {
  return {s * v.x, s * v.y, s * v.z};
}

}  // namespace vex::checker

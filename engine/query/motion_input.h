// What queries of bodies in motion refuse.
#pragma once

#include "engine/numeric/errors.h"
#include "engine/numeric/vec3.h"

namespace vex {

inline void require_end(double until) {
  if (!(until >= 0.0)) throw UsageError("the end of a motion is negative or no number - give a time from 0 up");
}

inline void require_motion(const Vec3d& motion, double until) {
  require_end(until);
  if (norm_1(motion) > 0.0 && is_finite(motion)) return;
  throw InputError("a direction of motion is zero or not finite - give a finite vector of any other length");
}

}  // namespace vex

// How deep the way between two bodies' centres is in what is known of their Minkowski difference (internal).
#pragma once

#include <cmath>

#include "engine/numeric/vec3.h"

namespace vex {

/// How far x is inside of the hull of the ball of radius `core` about 0 and of `tip`, at least; below 0 outside. Of the
/// balls of radius (1 - part) core about part * tip, which are in the hull, one of those that hold most of x is taken:
/// any part from 0 to 1 would do for the proof (E26).
inline double depth_around_core(const Vec3d& x, const Vec3d& tip, double core) {
  const double tip_sq = dot(tip, tip), along = dot(x, tip) / tip_sq;
  const double across_sq = std::fmax(dot(x, x) - along * along * tip_sq, 0.0);
  const double best = along - core * std::sqrt(across_sq / (tip_sq * (tip_sq - core * core)));
  const double part = best > 0.0 ? (best < 1.0 ? best : 1.0) : 0.0;  // also where it is no number
  return (1.0 - part) * core - norm(x - part * tip);
}

}  // namespace vex

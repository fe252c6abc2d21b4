// Where a body's volume is: its centroid, and its second moments about it.
#pragma once

#include <array>

#include "engine/numeric/vec3.h"

namespace vex {

/// Of a body of unit density. The moment of inertia about a unit axis n through the centroid is tr C - n . C n.
struct SolidMoments {
  double volume = 0.0;            // length^3
  Vec3d centroid;                 // length
  std::array<Vec3d, 3> second{};  // rows of C, the integral of x x^T about the centroid; length^5

  static SolidMoments diagonal(double volume, const Vec3d& centroid, const Vec3d& squares) {
    return {volume, centroid, {{{squares.x, 0.0, 0.0}, {0.0, squares.y, 0.0}, {0.0, 0.0, squares.z}}}};
  }
};

}  // namespace vex

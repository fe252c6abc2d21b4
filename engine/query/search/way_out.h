// A shorter way out of each other for two bodies, where the expanding polytope was given up: one of ever so many that
// are about as short, as of bodies on one axis, and then a polytope spends its points on all of them.
//
// A way out along n ends where a ray along it leaves A - B. The plane there is that of another direction, n', of which
// the ray search (ray_search.h) finds all digits; and along n' the way out is no longer. Again from n', until it is no
// shorter.
#pragma once

#include "engine/query/search/core_difference.h"

namespace vex {

struct WayOut {
  bool is_found = false;
  Vec3d normal;                          // unit
  double height = 0.0;                   // of the cores' difference along it, as its support mapping has it
  Vec3d point_a, point_b, point_b_in_b;  // of the bodies, where the ray along the normal leaves
  int n_support_calls = 0;
};

/// The height along the unit vector `first_normal` is `first_height`: that way, with its points, or a shorter one. A
/// way that is shorter by less than `least_gain` is not worth another ray.
WayOut shorter_way_out(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                       const CoreDifference& difference, const Vec3d& first_normal, double first_height,
                       double least_gain);

}  // namespace vex

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
  Vec3d normal;          // unit
  double height = 0.0;   // of the cores' difference along it, as its support mapping has it
  Vec3d core_a, core_b;  // points of the cores about where the ray leaves
  Vec3d own_core_b;      // in B's frame
  int n_support_calls = 0;
  bool is_shorter = false;
};

/// `height` is that of the difference along the unit vector `normal`; a way that is shorter by less than `least_gain`
/// is not worth it.
WayOut shorter_way_out(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                       const CoreDifference& difference, const Vec3d& normal, double height, double least_gain);

}  // namespace vex

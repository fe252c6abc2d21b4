// Bounds of a placed body: an axis-aligned box of the scene's frame, and an oriented box.
#pragma once

#include <algorithm>

#include "engine/numeric/pose.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The points with lower <= p <= upper, coordinate by coordinate.
struct Aabb {
  Vec3d lower, upper;

  bool contains(const Vec3d& p) const {
    return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y && lower.z <= p.z && p.z <= upper.z;
  }
  bool meets(const Aabb& other) const {
    return lower.x <= other.upper.x && other.lower.x <= upper.x && lower.y <= other.upper.y &&
           other.lower.y <= upper.y && lower.z <= other.upper.z && other.lower.z <= upper.z;
  }
};

/// The smallest box that holds both.
inline Aabb hull_of(const Aabb& a, const Aabb& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y), std::min(a.lower.z, b.lower.z)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y), std::max(a.upper.z, b.upper.z)}};
}

/// A box with axes of its own: centre + R x with |x_i| <= half_extents_i, R the rotation of `world_from_box`, whose
/// translation is the centre.
struct OrientedBox {
  Transformd world_from_box;
  Vec3d half_extents;
};

/// Holds the placed body, rounding included; off by no more than the body's support error and some 64 roundings of its
/// reach and its translation. Six support points: of a needle on the diagonal it is the needle's box, not its ball's.
Aabb bounding_box(const ConvexBody& body, const Pose& world_from_body);

/// The same with the axes of the body's own frame: tighter for needles and plates that lie askew.
OrientedBox oriented_bounding_box(const ConvexBody& body, const Pose& world_from_body);

}  // namespace vex

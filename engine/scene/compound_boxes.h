// Boxes of what compounds are asked of, wide enough whichever frame the parts are seen from (internal).
#pragma once

#include <cmath>
#include <limits>

#include "engine/numeric/pose_algebra.h"
#include "engine/scene/aabb.h"
#include "engine/support/convex_body.h"

namespace vex {

/// What separates lengths that a part sees from those of its compound's frame, R^T R being 1 to within 1e-6 (E30).
inline constexpr double kSeenOtherwise = 0x1p-16;

/// Holds the body at this pose, as any part sees it, R^T of which stands for its inverse, and as composed poses have
/// it.
inline Aabb box_seen(const ConvexBody& body, const Pose& frame_from_body) {
  const Aabb box = bounding_box(body, frame_from_body);
  const double more = kSeenOtherwise * body.reach() +
                      0x1p-46 * (norm_1(frame_from_body.a_from_b().translation) + body.reach()) + 0x1p-500;
  const Aabb wide{box.lower - Vec3d{more, more, more}, box.upper + Vec3d{more, more, more}};
  const auto is_ordered = [](const Vec3d& p, const Vec3d& q) { return p.x <= q.x && p.y <= q.y && p.z <= q.z; };
  // A support mapping that breaks its promises may give a box of NaNs, which meets nothing: every part is asked then.
  constexpr double far = std::numeric_limits<double>::infinity();
  return is_ordered(wide.lower, wide.upper) ? wide : Aabb{{-far, -far, -far}, {far, far, far}};
}

/// A box of another frame, as this one sees it.
inline Aabb box_seen(const Aabb& box, const Pose& frame_from_box) {
  const Transformd& pose = frame_from_box.a_from_b();
  const Vec3d half = 0.5 * box.upper - 0.5 * box.lower, centre = pose(0.5 * box.upper + 0.5 * box.lower);
  const auto extent = [&half](const Vec3d& row) {
    return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
  };
  const double more = kSeenOtherwise * (norm_1(half) + norm_1(centre)) + 0x1p-46 * norm_1(pose.translation) + 0x1p-500;
  const Vec3d wide = Vec3d{extent(pose.row_x), extent(pose.row_y), extent(pose.row_z)} + Vec3d{more, more, more};
  return {centre - wide, centre + wide};
}

/// A distance that a part tells, in the compound's frame, rounded up.
inline double distance_seen(double distance) { return distance * (1.0 + kSeenOtherwise) + 0x1p-500; }

}  // namespace vex

#include "engine/scene/aabb.h"

#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// h(d) of the body about its own origin along a direction of length 1 to within 1e-6, rounded up: the support point is
// off by the body's own error, and the product by some roundings of its reach.
double height(const ConvexBody& body, const Vec3d& dir) {
  return dot(dir, body.support(dir)) + (body.support_error() + 8.0 * kUnitRoundoff * body.reach()) * norm_1(dir);
}

}  // namespace

Aabb bounding_box(const ConvexBody& body, const Pose& world_from_body) {
  const Transformd& pose = world_from_body.a_from_b();
  // e_i . (R x + t) = (row i of R) . x + t_i, so the largest is the body's height along the row.
  const auto upper = [&](const Vec3d& row, double t) {
    const double extent = height(body, row) + t;
    return extent + 2.0 * kUnitRoundoff * std::fabs(extent);
  };
  const auto lower = [&](const Vec3d& row, double t) { return -upper(-row, -t); };
  const Vec3d& t = pose.translation;
  return {{lower(pose.row_x, t.x), lower(pose.row_y, t.y), lower(pose.row_z, t.z)},
          {upper(pose.row_x, t.x), upper(pose.row_y, t.y), upper(pose.row_z, t.z)}};
}

OrientedBox oriented_bounding_box(const ConvexBody& body, const Pose& world_from_body) {
  const Aabb own = bounding_box(body, Pose());
  const Vec3d middle = 0.5 * (own.lower + own.upper);
  OrientedBox box{world_from_body.a_from_b(), own.upper - middle};
  box.half_extents = {std::fmax(box.half_extents.x, middle.x - own.lower.x),
                      std::fmax(box.half_extents.y, middle.y - own.lower.y),
                      std::fmax(box.half_extents.z, middle.z - own.lower.z)};
  box.world_from_box.translation = world_from_body.a_from_b()(middle);
  // What rounding the middle, its place and the differences may cost.
  const double error =
      16.0 * kUnitRoundoff * (norm_1(middle) + norm_1(box.half_extents) + norm_1(box.world_from_box.translation));
  box.half_extents = box.half_extents + Vec3d{error, error, error};
  return box;
}

}  // namespace vex

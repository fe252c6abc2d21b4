// Rays and moving bodies against compounds: along the tree of their parts' boxes, and no later than what is proven to
// be met.
#include "engine/numeric/errors.h"
#include "engine/query/motion_input.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "engine/scene/compound_boxes.h"
#include "engine/scene/earliest_contact.h"

namespace vex {
namespace {

FirstContact seen_by_compound(const Compound& a, std::uint32_t part, const FirstContact& found) {
  return a.is_in_place(part) ? found : in_world(found, a.compound_from_part(part));
}

void cast_part(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion, std::uint32_t part_b,
               EarliestContact& earliest) {
  along_way(a, moving_box(box_seen(b, a_from_b)), motion, part_b, earliest, [&](std::uint32_t part, double until) {
    const Transformd& pose = a.compound_from_part(part).a_from_b();
    const Vec3d seen = a.is_in_place(part) ? motion : motion_seen_from(pose, motion);
    return seen_by_compound(a, part, linear_cast(a.body(part), b, a.part_from_b(part, a_from_b), seen, until));
  });
}

}  // namespace

CompoundContact cast_ray(const Compound& a, const Vec3d& origin, const Vec3d& dir, double until) {
  require_motion(dir, until);
  if (!is_finite(origin)) throw InputError("a ray's origin is not finite - give finite numbers");
  EarliestContact earliest(until);
  along_way(a, {origin, {}}, dir, 0, earliest, [&](std::uint32_t part, double last) {
    const Transformd& pose = a.compound_from_part(part).a_from_b();
    if (a.is_in_place(part)) return cast_ray(a.body(part), origin, dir, last);
    return in_world(
        cast_ray(a.body(part), pose.direction_to_b(origin - pose.translation), motion_seen_from(pose, dir), last),
        a.compound_from_part(part));
  });
  return earliest.answer();
}

CompoundContact linear_cast(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion,
                            double until) {
  require_motion(motion, until);
  EarliestContact earliest(until);
  cast_part(a, b, a_from_b, motion, 0, earliest);
  return earliest.answer();
}

CompoundContact linear_cast(const Compound& a, const Compound& b, const Pose& a_from_b, const Vec3d& motion,
                            double until) {
  require_motion(motion, until);
  EarliestContact earliest(until);
  for (std::size_t part = 0; part < b.size(); ++part) {
    cast_part(a, b.body(part), b.frame_from_part(part, a_from_b), motion, static_cast<std::uint32_t>(part), earliest);
    if (earliest.is_at_start()) break;
  }
  return earliest.answer();
}

CompoundContact linear_cast(const HalfSpace& a, const Compound& b, const Pose& a_from_b, const Vec3d& motion,
                            double until) {
  require_motion(motion, until);
  EarliestContact earliest(until);
  for (std::uint32_t part = 0; part < b.size() && !earliest.is_at_start(); ++part) {
    earliest.take(0, part, linear_cast(a, b.body(part), b.frame_from_part(part, a_from_b), motion, earliest.until()));
  }
  return earliest.answer();
}

}  // namespace vex

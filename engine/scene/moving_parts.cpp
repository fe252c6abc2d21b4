#include "engine/scene/moving_parts.h"

#include "engine/query/world_queries.h"
#include "engine/support/displaced_body.h"

namespace vex {
namespace {

// s with R s = t: what R^T t is short of it, R being a rotation to 1e-6 only, falls by as much in each step.
Vec3d unturned(const Transformd& pose) {
  Transformd turn = pose;
  turn.translation = {};
  Vec3d s = pose.direction_to_b(pose.translation);
  for (int k = 0; k < 3; ++k) s = s + pose.direction_to_b(pose.translation - turn(s));
  return s;
}

RigidMotion seen_by(const Transformd& own, const RigidMotion& motion) {
  return {motion_seen_from(own, motion.velocity), motion_seen_from(own, motion.angular_velocity)};
}

}  // namespace

std::vector<MovingPart> moving_parts(const Compound& b, const Pose& frame_from_b, bool does_turn) {
  std::vector<MovingPart> parts;
  for (std::uint32_t k = 0; k < b.size(); ++k) {
    const Transformd& own = b.compound_from_part(k).a_from_b();
    if (!does_turn || !(norm_1(own.translation) > 0.0)) {
      parts.push_back({b.body(k), b.frame_from_part(k, frame_from_b), {}, k});
      continue;
    }
    const Vec3d by = unturned(own);
    Transformd turned = own;
    turned.translation = {};
    parts.push_back({DisplacedBody(b.body(k), by), frame_from_b * Pose::unchecked(turned), by, k});
  }
  return parts;
}
std::vector<MovingPart> moving_parts(const ConvexBody& b, const Pose& frame_from_b, bool /*does_turn*/) {
  return {{b, frame_from_b, {}, 0}};
}

MovingPair moving_pair(const Compound& a, std::uint32_t part, const MovingPart& b, const RigidMotion& motion_a,
                       const RigidMotion& motion_b) {
  if (a.is_in_place(part)) {
    return {a.body(part), b.body, b.frame_from_body, motion_a, motion_b, Pose(), true, b.displaced_by};
  }
  const Pose& compound_from_part = a.compound_from_part(part);
  const Transformd& own = compound_from_part.a_from_b();
  const RigidMotion of_a = seen_by(own, motion_a), of_b = seen_by(own, motion_b);
  if (!turns(motion_a) || !(norm_1(own.translation) > 0.0)) {
    return {a.body(part), b.body,        a.part_from_b(part, b.frame_from_body), of_a, of_b, compound_from_part,
            false,        b.displaced_by};
  }
  Transformd turned = own;
  turned.translation = {};
  const Pose frame = Pose::unchecked(turned);
  return {DisplacedBody(a.body(part), own.direction_to_b(own.translation)),
          b.body,
          relative_pose(frame, b.frame_from_body),
          of_a,
          of_b,
          frame,
          false,
          b.displaced_by};
}

FirstContact seen_by_compounds(FirstContact found, const MovingPair& pair) {
  if (found.verdict.outcome == Outcome::overlap) found.point_b_in_b = found.point_b_in_b - pair.displaced_by;
  return pair.is_in_place ? found : in_world(found, pair.compound_from_a);
}

}  // namespace vex

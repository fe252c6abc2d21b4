// Parts of compounds that may turn, each told about the origin that it turns about (internal).
#pragma once

#include <vector>

#include "engine/query/first_contact.h"
#include "engine/scene/compound.h"

namespace vex {

/// Of B, or a part of it, as it moves; its number among the parts.
struct MovingPart {
  ConvexBody body;
  Pose frame_from_body;
  Vec3d displaced_by;
  std::uint32_t number;
};
std::vector<MovingPart> moving_parts(const Compound& b, const Pose& frame_from_b, bool does_turn);
std::vector<MovingPart> moving_parts(const ConvexBody& b, const Pose& frame_from_b, bool does_turn);

inline bool turns(const RigidMotion& motion) { return norm_1(motion.angular_velocity) > 0.0; }

/// What is asked of a pair of parts: two bodies, B's pose and both motions as the part of A has them; and the frame of
/// that in the compound's.
struct MovingPair {
  ConvexBody a, b;
  Pose pose;
  RigidMotion of_a, of_b;
  Pose compound_from_a;
  bool is_in_place;
  Vec3d displaced_by;  // of b's points
};
MovingPair moving_pair(const Compound& a, std::uint32_t part, const MovingPart& b, const RigidMotion& motion_a,
                       const RigidMotion& motion_b);

/// The pair's answer in the compound's frame, B's point in the frame of its part.
FirstContact seen_by_compounds(FirstContact found, const MovingPair& pair);

}  // namespace vex

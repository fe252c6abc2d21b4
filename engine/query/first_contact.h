// When does a motion first bring a body into contact with another one: ray cast, linear cast, and time of impact of a
// body that turns while it moves.
#pragma once

#include <cmath>

#include "engine/numeric/pose.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Answers of all three. Times are in units of the motion given: at time t a ray is at origin + t dir, a body moved by
/// t times its motion. Points and normals are in A's frame.
struct FirstContact {
  /// Overlap: there is a contact, proven. Disjoint: there is none at any time t >= 0, proven. Undecided: the motion
  /// grazes to within rounding, and not both bodies are polytopes, which are always decided; it touches within rounding
  /// of `until`; or the time, or a coordinate of a point, is larger than any double.
  Verdict verdict;
  /// The first time of contact is between `lower` and `upper`, and so is `time`; 0 where there is contact at the start.
  /// Of bodies that turn `time` is `lower`: where they touch at the start to within rounding, contact may be proven
  /// much later only. Where the verdict is disjoint all three are infinite; where it is undecided, a contact, if any,
  /// is not before `lower`, and `upper` is infinite.
  double time = 0.0, lower = 0.0, upper = 0.0;
  /// A unit vector along which the bodies first touch, from A towards what moves (of contact at the start, that of
  /// `signed_distance`).
  Vec3d normal;
  /// Where they touch: points of A and of B as placed at `time`, each of its body to 1e-12 of R_A + R_B, of curved
  /// bodies to 1e-9, and to 16 roundings of coordinates; of a ray, the ray's point and the body's nearest one. Along
  /// the normal they are one as nearly; across it, where surfaces leave each other by less than rounding, to 1e-8 of
  /// R_A + R_B; both but for how far the bodies move between the bounds.
  Vec3d point_a, point_b;
  int n_support_calls = 0;
  /// The point of B in B's frame, where it is known as well however far B is from A.
  Vec3d point_b_in_b{};
};

/// The ray origin + t dir, t >= 0, against a body in its own frame; `dir` has any length but 0. The normal points out
/// of the body. What all three are given as `until`, a time from 0 on, is the last one that is looked at: `disjoint`
/// then says that there is no contact until then, and an overlap's `upper` is not later.
FirstContact cast_ray(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir, double until = HUGE_VAL);

/// B moving without turning: at time t >= 0 it is where the pose has it plus t * motion.
FirstContact linear_cast(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                         double until = HUGE_VAL);

/// In A's frame; a screw about B's origin, which moves straight.
struct RigidMotion {
  Vec3d velocity;
  Vec3d angular_velocity;  // radians per unit of time
};

/// B at time t: x -> exp(t [w]) R x + (translation + t v), without rounding but at the start, where it is what
/// `overlap` has; of a polytope that does not turn, nor A, what `overlap` has at the start, moved by t v. By
/// conservative advancement (B. Mirtich, 1996): as long as the bodies' gap is larger than what any point of B can move
/// along the separating direction, they do not touch. Ends where they touch, once circumscribed balls part for good,
/// or, of a body that only turns, after one turn.
FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                            double until = HUGE_VAL);

/// The same where A moves as well: x -> exp(t [w]) x + t v, in its own frame as it is at first, in which points and
/// normal are given. A body at rest has RigidMotion{}; a mere {} would be an end of 0. Of bodies whose origins keep
/// their distance and that both turn nothing ends the search but `until` or its cap.
FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                            const RigidMotion& motion_b, double until = HUGE_VAL);

/// B's pose at a time of the motion.
Transformd pose_at(const Transformd& a_from_b, const RigidMotion& motion, double time);

}  // namespace vex

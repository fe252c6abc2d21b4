// Poses one after another, the other way round, between two others, and of two bodies as one sees the other.
//
// All of it rounds: what comes out is a pose of doubles near the one that is meant, and a query that takes it answers
// about those doubles.
#pragma once

#include <array>

#include "engine/numeric/pose.h"

namespace vex {

/// a_from_b * b_from_c == a_from_c: R = R_1 R_2, t = R_1 t_2 + t_1, sums of products from left to right, each operation
/// rounded; no fused ones. Each product adds some 4 u to what R is off from a rotation; throws InputError where that
/// has come to more than Pose::kRotationTolerance (make a pose anew by `pose_of` and `quaternion_of` then).
Pose operator*(const Pose& a_from_b, const Pose& b_from_c);

/// b_from_a: R^T and -(R^T t), each operation rounded. The inverse as nearly as R is a rotation: R^T R is 1 to within
/// 1e-6, of a pose from a quaternion to within some 8 u. That of a Pose throws InputError where R is a rotation to
/// within Pose::kRotationTolerance and R^T, by a last part of it, is not.
Transformd inverse(const Transformd& a_from_b);
Pose inverse(const Pose& a_from_b);

/// The rotation of the quaternion w + xi + yj + zk (rotation_from_quaternion), then the translation. Throws InputError.
Pose pose_of(const std::array<double, 4>& quaternion, const Vec3d& translation);

/// w, x, y, z of length 1, of R without its translation. The largest component is found first (S. W. Shepperd, J.
/// Guidance and Control 1, 223, 1978), so that it is none that rounding leaves nothing of.
std::array<double, 4> quaternion_of(const Transformd& pose);

/// The pose at this part, from 0 to 1, of the way between two: the frame turns about one axis, evenly and by the
/// shorter arc (K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985), while its origin moves in a
/// straight line, evenly. At 0 and 1 the given poses, bit for bit; between, R is a rotation to rounding, and within
/// 1e-15 of the turn between the given ones, and twice what these are off from rotations. Of poses that are half a turn
/// apart both arcs are as long, and which one is taken is not told. Throws UsageError for a part that is not from 0
/// to 1.
Pose interpolated(const Pose& from, const Pose& to, double part);

/// What queries of two bodies in one frame are asked about: b's pose in a's frame, b moved by `shift` before. R = R_a^T
/// R_b, t = R_a^T ((t_b - t_a) + shift), sums of products from left to right, each operation rounded. Translations are
/// subtracted first: the rounding grows with how far the bodies are from each other, and not with how far from the
/// origin of the frame.
Transformd relative_pose(const Transformd& world_from_a, const Transformd& world_from_b, const Vec3d& shift);
/// The same, checked. Throws InputError where the product of the rotations is none to within Pose::kRotationTolerance,
/// which needs one of them that is off by more than 2e-7.
Pose relative_pose(const Pose& world_from_a, const Pose& world_from_b);

/// No point of B, up to `reach_b` from the origin of its frame, is farther than this, as a query that is given
/// `relative_pose` has it, from where the two poses as given, without any rounding, have it as A sees it (R_a inverted,
/// not transposed): docs/derivations.md, E28. `ball_radius_a`: A's (ConvexBody::ball_radius), for a ball stays one
/// whatever R_a is. Some 60 u of the reach and of |t_b - t_a| for rotations from quaternions; for those that are off by
/// more, 3 times as much as they are off. So bodies that are proven to be farther apart than this, or deeper in each
/// other, are so for the poses as given, too.
double relative_pose_error(const Pose& world_from_a, const Pose& world_from_b, double reach_b,
                           double ball_radius_a = 0.0);

/// What a body in the frame of `world_from_a` sees of a motion of the world: R^T v, each operation rounded. Throws
/// InputError for a motion other than 0 that is so short (1e-290) that its rounding would be no more a small part of
/// it.
Vec3d motion_seen_from(const Transformd& world_from_a, const Vec3d& motion);

/// R v, each operation rounded: a direction of frame B seen from frame A. Back goes Transform::direction_to_b.
inline Vec3d direction_to_a(const Transformd& a_from_b, const Vec3d& dir) {
  return {dot(a_from_b.row_x, dir), dot(a_from_b.row_y, dir), dot(a_from_b.row_z, dir)};
}

}  // namespace vex

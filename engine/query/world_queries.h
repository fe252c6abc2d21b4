// Queries of two bodies that each have a pose in the world, and of rays in the world.
//
// What they answer about is one definite pose, `relative_pose(world_from_a, world_from_b)`: the answer is that of the
// query of that pose, to the bit, with normal and points taken to the world's frame. It is proven as that one is. Two
// poses are rounded into one by less than `relative_pose_error`, which does not grow with how far both bodies are from
// the world's origin; a scene does the same with its pairs (docs/decisions/0028-world-poses-and-compounds.md).
#pragma once

#include "engine/numeric/pose_algebra.h"
#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"

namespace vex {

/// Normal and points in the world's frame instead of A's; point_b_in_b stays. The normal is turned and made a unit
/// vector again, so it is within 1e-6 of R n, and 4 u; points are rounded to doubles of the world, and off by some 8
/// roundings of coordinates there: far from the origin differences of two of them have few digits, and what is known of
/// the points is in the answer in A's frame, and in `point_b_in_b`.
Separation in_world(Separation in_a, const Pose& world_from_a);
FirstContact in_world(FirstContact in_a, const Pose& world_from_a);
ContactManifold in_world(ContactManifold in_a, const Pose& world_from_a);

/// Each as the function of engine/query with the same name and settings, of b's pose in a's frame.
Verdict overlap(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                OverlapCertificate* certificate = nullptr);
Separation signed_distance(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                           const SeparationSettings& settings = {}, WarmStart* warm_start = nullptr);
Separation distance(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                    const SeparationSettings& settings = {}, WarmStart* warm_start = nullptr);
Separation penetration_depth(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b,
                             const Pose& world_from_b, const SeparationSettings& settings = {},
                             WarmStart* warm_start = nullptr);
ContactManifold contact_manifold(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b,
                                 const Pose& world_from_b, double margin = 0.0, double feature_angle = 0.01);

/// Rays and motions of the world's frame. A's frame sees R_a^T (origin - t_a), R_a^T dir and R_a^T of velocities, each
/// operation rounded: these are what is answered about, bounds and verdict. Of a way that grazes a body, the time for the
/// one as given may be another one by much more than a rounding. Motions shorter than 1e-290 are refused
/// (motion_seen_from).
FirstContact cast_ray(const ConvexBody& a, const Pose& world_from_a, const Vec3d& origin, const Vec3d& dir,
                      double until = HUGE_VAL);
FirstContact linear_cast(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                         const Vec3d& motion_of_b, double until = HUGE_VAL);
/// Both may move, each turning about the origin of its own frame, which moves straight. Points and normal are in the
/// world's frame as they are at `time`.
FirstContact time_of_impact(const ConvexBody& a, const Pose& world_from_a, const RigidMotion& motion_of_a,
                            const ConvexBody& b, const Pose& world_from_b, const RigidMotion& motion_of_b,
                            double until = HUGE_VAL);

}  // namespace vex

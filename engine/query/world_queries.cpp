#include "engine/query/world_queries.h"

namespace vex {
namespace {

// A zero vector stays one: an answer without witnesses.
Vec3d unit_in_world(const Transformd& world_from_a, const Vec3d& unit) {
  const Vec3d turned = direction_to_a(world_from_a, unit);
  const double length = norm(turned);
  return length > 0.0 ? Vec3d{turned.x / length, turned.y / length, turned.z / length} : unit;
}

template <class Answer>
Answer with_points_in_world(Answer in_a, const Pose& world_from_a) {
  if (!(norm_1(in_a.normal) > 0.0)) return in_a;
  const Transformd& pose = world_from_a.a_from_b();
  in_a.normal = unit_in_world(pose, in_a.normal);
  in_a.point_a = pose(in_a.point_a);
  in_a.point_b = pose(in_a.point_b);
  return in_a;
}

RigidMotion seen_from(const Pose& world_from_a, const RigidMotion& motion) {
  const Transformd& pose = world_from_a.a_from_b();
  return {motion_seen_from(pose, motion.velocity), motion_seen_from(pose, motion.angular_velocity)};
}

}  // namespace

Separation in_world(Separation in_a, const Pose& world_from_a) { return with_points_in_world(in_a, world_from_a); }
FirstContact in_world(FirstContact in_a, const Pose& world_from_a) { return with_points_in_world(in_a, world_from_a); }
ContactManifold in_world(ContactManifold in_a, const Pose& world_from_a) {
  in_a.separation = in_world(in_a.separation, world_from_a);
  for (auto& contact : in_a.contacts) {
    contact.point_a = world_from_a.a_from_b()(contact.point_a);
    contact.point_b = world_from_a.a_from_b()(contact.point_b);
  }
  return in_a;
}

Verdict overlap(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                OverlapCertificate* certificate) {
  return overlap(a, b, relative_pose(world_from_a, world_from_b), certificate);
}

Separation signed_distance(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                           const SeparationSettings& settings, WarmStart* warm_start) {
  return in_world(signed_distance(a, b, relative_pose(world_from_a, world_from_b), settings, warm_start), world_from_a);
}

Separation distance(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                    const SeparationSettings& settings, WarmStart* warm_start) {
  return in_world(distance(a, b, relative_pose(world_from_a, world_from_b), settings, warm_start), world_from_a);
}

Separation penetration_depth(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b,
                             const Pose& world_from_b, const SeparationSettings& settings, WarmStart* warm_start) {
  return in_world(penetration_depth(a, b, relative_pose(world_from_a, world_from_b), settings, warm_start),
                  world_from_a);
}

ContactManifold contact_manifold(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b,
                                 const Pose& world_from_b, double margin, double feature_angle) {
  return in_world(contact_manifold(a, b, relative_pose(world_from_a, world_from_b), margin, feature_angle),
                  world_from_a);
}

FirstContact cast_ray(const ConvexBody& a, const Pose& world_from_a, const Vec3d& origin, const Vec3d& dir,
                      double until) {
  const Transformd& pose = world_from_a.a_from_b();
  return in_world(cast_ray(a, pose.direction_to_b(origin - pose.translation), motion_seen_from(pose, dir), until),
                  world_from_a);
}

FirstContact linear_cast(const ConvexBody& a, const Pose& world_from_a, const ConvexBody& b, const Pose& world_from_b,
                         const Vec3d& motion_of_b, double until) {
  const Pose pose = relative_pose(world_from_a, world_from_b);
  return in_world(linear_cast(a, b, pose, motion_seen_from(world_from_a.a_from_b(), motion_of_b), until), world_from_a);
}

FirstContact time_of_impact(const ConvexBody& a, const Pose& world_from_a, const RigidMotion& motion_of_a,
                            const ConvexBody& b, const Pose& world_from_b, const RigidMotion& motion_of_b,
                            double until) {
  const Pose pose = relative_pose(world_from_a, world_from_b);
  return in_world(
      time_of_impact(a, b, pose, seen_from(world_from_a, motion_of_a), seen_from(world_from_a, motion_of_b), until),
      world_from_a);
}

}  // namespace vex

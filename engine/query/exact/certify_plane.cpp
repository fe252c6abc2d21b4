// Finds the certificates of what half-spaces answer. Nothing here is believed: the checker judges what is found.
#include "engine/query/exact/nearest_witnesses.h"
#include "engine/query/half_space_certificate.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/plane_sweep.h"

namespace vex {

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Separation& found) {
  HalfSpaceCertificate certificate;
  if (!found.has_witnesses) return certificate;
  certificate.near_b.push_back(
      nearest_of_b(b, {}, found.point_b_in_b, pose.a_from_b().direction_to_b(a.unit_normal())));
  return certificate;
}

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                             const FirstContact& found, double until) {
  return certify(a, b, pose, RigidMotion{motion, {}}, found, until);
}

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                             const FirstContact& found, double until) {
  HalfSpaceCertificate certificate;
  const bool meets = found.verdict.outcome == Outcome::overlap;
  if (meets) {
    const Transformd then = pose_at(pose.a_from_b(), motion, found.time);
    certificate.near_b.push_back(nearest_of_b(b, {}, found.point_b_in_b, then.direction_to_b(a.unit_normal())));
  }
  if (!(norm_1(motion.angular_velocity) > 0.0) || (meets && found.upper == 0.0)) return certificate;
  std::vector<ApartDuring> record;
  time_of_impact(a, b, pose, motion, until, record);
  for (const ApartDuring& step : record) certificate.clear.push_back({step.from, step.to});
  if (!meets) return certificate;
  const Vec3d down = pose_at(pose.a_from_b(), motion, found.upper).direction_to_b(-a.dir_normal());
  Witness lowest{};
  lowest.dir_b = down;
  lowest.point_b = b.core_support(down);
  certificate.lowest.push_back(lowest);
  return certificate;
}

HalfSpaceCertificate certify(const HalfSpace& /*a*/, const ConvexBody& b, const Pose& pose,
                             std::span<const PlaneContact> found) {
  HalfSpaceCertificate certificate;
  for (const PlaneContact& contact : found) {
    const Vec3d own = pose.a_from_b().direction_to_b(contact.point_b - pose.a_from_b().translation);
    certificate.near_b.push_back(nearest_of_b(b, {}, own, {}));
  }
  return certificate;
}

}  // namespace vex

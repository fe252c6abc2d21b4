// Proof of what a half-space was asked of a body, apart from what found it.
#pragma once

#include <span>
#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/half_space.h"
#include "engine/query/plane_contacts.h"

namespace vex {

/// What re-proves an answer of a half-space. Verdicts and bounds of bodies at rest, and of straight motions, need
/// nothing: the least height over a plane is a number that the exact form tells.
///
/// Of points: those of B in `near_b`, one set for each, have it near their hull, as far as the radius of the ball. Of a
/// motion that turns: times in which the body stays over the plane, one interval after the other until the contact; and
/// a point of B that has come to the plane, or within the ball's radius of it, at the contact's `upper`.
struct HalfSpaceCertificate {
  struct Clear {
    double from, to;
  };
  std::vector<std::vector<Witness>> near_b;
  std::vector<Clear> clear;
  std::vector<Witness> lowest;
};

/// Find a certificate for an answer; slow. What is not found is left out, and the checker says so.
HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Separation& found);
HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                             const FirstContact& found, double until = HUGE_VAL);
HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                             const FirstContact& found, double until = HUGE_VAL);
HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose,
                             std::span<const PlaneContact> found);

/// Prove verdict, bounds and points again, in exact arithmetic, from the body's exact form and the certificate alone:
/// of `signed_distance`, `linear_cast` and `time_of_impact`. Undecided answers claim their bounds.
CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Separation& claimed,
                                   const HalfSpaceCertificate& certificate);
CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                                   const FirstContact& claimed, const HalfSpaceCertificate& certificate,
                                   double until = HUGE_VAL);
CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                                   const FirstContact& claimed, const HalfSpaceCertificate& certificate,
                                   double until = HUGE_VAL);
/// Of `PlaneContacts`: that each point is one of the body, as high over the plane as is said, no farther than the
/// margin, and opposite its point on the plane; and that one of them is as low as the body. Not that there are no more.
CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose,
                                   std::span<const PlaneContact> claimed, const HalfSpaceCertificate& certificate,
                                   double margin = 0.0);

}  // namespace vex

// Proof of what a ray, a linear cast or a time of impact was answered, apart from the search that found it.
#pragma once

#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/first_contact.h"

namespace vex {

/// What re-proves a `FirstContact`.
///
/// No contact before `lower`, or none at all: directions that keep the bodies apart, each for an interval of time;
/// together they cover all times in question but those in which balls around the bodies are apart. At the start they
/// meet, or, of a motion that turns, are apart, by `at_start`. A later contact, of a straight motion: the hull of points
/// of A - B, each of B as it is at some time between `lower` and `upper`, holds the origin, and such hulls are of what
/// the difference passes through in that time. Of a body that turns, all of B at `upper`. Its points: those of A in
/// `near_a` have `point_a` near their hull as A is at `time`, as far apart as the radius of the ball, and those of B in
/// `near_b` have `point_b_in_b`.
struct ContactCertificate {
  struct Apart {
    double from, to;  // infinite: for ever after
    ExactVector dir;  // in A's frame, from A towards B
  };
  std::vector<Apart> apart;
  OverlapCertificate at_start;
  WitnessHull hull;
  std::vector<double> times;  // of each witness
  std::vector<Witness> near_a, near_b;
};

/// Find a certificate for an answer of `linear_cast`, or of `time_of_impact`, with the end that they were given; slow.
/// What is not found is left out, and the checker says so. Of an undecided answer nothing is looked for but what proves
/// `lower`.
ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                           const FirstContact& found, double until = HUGE_VAL);
ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                           const FirstContact& found, double until = HUGE_VAL);

/// Of two bodies that move.
ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                           const RigidMotion& motion_b, const FirstContact& found, double until = HUGE_VAL);
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const FirstContact& claimed, const ContactCertificate& certificate,
                                   double until = HUGE_VAL);

/// Of `cast_ray`: B is the ray's origin, a point.
ContactCertificate certify_ray(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir, const FirstContact& found,
                               double until = HUGE_VAL);
CertificateCheck check_ray_certificate(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir,
                                       const FirstContact& claimed, const ContactCertificate& certificate,
                                       double until = HUGE_VAL);

/// Proves verdict and bounds again, in exact arithmetic, from the bodies' exact forms and the certificate alone. An
/// undecided answer claims `lower`.
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                                   const FirstContact& claimed, const ContactCertificate& certificate,
                                   double until = HUGE_VAL);
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const RigidMotion& motion, const FirstContact& claimed,
                                   const ContactCertificate& certificate, double until = HUGE_VAL);

}  // namespace vex

// Proof of what compounds answer, made of proofs of their pairs of parts.
#pragma once

#include <vector>

#include "engine/query/contact_certificate.h"
#include "engine/query/half_space_certificate.h"
#include "engine/query/separation_certificate.h"
#include "engine/scene/compound.h"

namespace vex {

/// Of every pair of parts what is claimed of it, as the part of A sees it, and what proves that. Where the unions
/// overlap the pair that is told is enough.
struct CompoundCertificate {
  struct OfPair {
    PartPair parts;
    Separation found;
    SeparationCertificate proof;
  };
  std::vector<OfPair> pairs;
};
/// The same of a motion; each pair is looked at until a time of its own.
struct CompoundContactCertificate {
  struct OfPair {
    PartPair parts;
    double until;
    FirstContact found;
    ContactCertificate proof;
  };
  std::vector<OfPair> pairs;
};
/// Of a half-space and every part of a compound.
struct CompoundOnPlaneCertificate {
  std::vector<Separation> found;
  std::vector<HalfSpaceCertificate> proofs;
};

/// Find a certificate for an answer of `distance`, of `linear_cast` or `time_of_impact`, or of `signed_distance` of a
/// half-space, each pair by `certify` of two bodies; slow, and the number of pairs counts. A cast has motions that do
/// not turn.
CompoundCertificate certify(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                            const CompoundSeparation& found);
CompoundCertificate certify(const Compound& a, const Compound& b, const Pose& a_from_b,
                            const CompoundSeparation& found);
CompoundContactCertificate certify(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& found, double until = HUGE_VAL);
CompoundContactCertificate certify(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& found, double until = HUGE_VAL);
CompoundOnPlaneCertificate certify(const HalfSpace& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& found);

/// Prove verdict and bounds of the union from proven answers of its pairs, by the checker of two bodies; and that
/// points and normal are those of the pair that is told, to how well they are known.
CertificateCheck check_certificate(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundCertificate& certificate);
CertificateCheck check_certificate(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundCertificate& certificate);
CertificateCheck check_certificate(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& claimed, const CompoundContactCertificate& certificate,
                                   double until = HUGE_VAL);
CertificateCheck check_certificate(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& claimed, const CompoundContactCertificate& certificate,
                                   double until = HUGE_VAL);
CertificateCheck check_certificate(const HalfSpace& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundOnPlaneCertificate& certificate);

}  // namespace vex

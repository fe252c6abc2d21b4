// Proof of a contact manifold, apart from the search that found it.
#pragma once

#include <vector>

#include "engine/query/contact_manifold.h"
#include "engine/query/separation_certificate.h"

namespace vex {

/// What re-proves a `ContactManifold`: its separation, and of each contact points of A and of B whose hulls come near
/// it.
struct ManifoldCertificate {
  struct Contact {
    std::vector<Witness> near_a, near_b;
  };
  SeparationCertificate separation;
  std::vector<Contact> contacts;
};

/// With the margin and the angle that the manifold was asked for.
ManifoldCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                            const ContactManifold& manifold);

/// Proves in exact arithmetic: the separation; of each contact that its points are on A and on B, on what of them is
/// within the feature angle across the normal, as far apart along it as is said, and no farther than the margin; and
/// that contacts are the corners of a convex polygon, counter-clockwise seen against the normal, which has the
/// separation's points in it. Not that the polygon could not be larger.
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const ContactManifold& claimed, const ManifoldCertificate& certificate,
                                   double margin = 0.0, double feature_angle = 0.01);

}  // namespace vex

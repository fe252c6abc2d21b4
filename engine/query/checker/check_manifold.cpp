// The checker of contact manifolds (docs/derivations.md, E25).
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/turning.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/manifold_certificate.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;
using whole::DyadicVector;
using Contact = ContactManifold::Contact;

// Of coordinates far from the origins of the frames.
constexpr double kRounding = 0x1p-44;

std::string fault_of_contact(const ExactPair& pair, const DyadicVector& normal, const Contact& contact,
                             const ManifoldCertificate::Contact& near, double tolerance, double off_face_a,
                             double off_face_b, double farthest) {
  if (!is_finite(contact.point_a) || !is_finite(contact.point_b) || !std::isfinite(contact.signed_distance)) {
    return "a contact is not finite";
  }
  const Dyadic allowed(tolerance);
  const DyadicVector of_a = whole::exactly(contact.point_a), of_b = whole::exactly(contact.point_b);
  if (!is_near_a(pair, near.near_a, of_a, allowed)) return "a contact's point of A is not proven to be on A";
  if (!is_near_b(pair, near.near_b, of_b, allowed)) return "a contact's point of B is not proven to be on B";
  // The normal is a unit vector but for rounding, which the tolerance has.
  const Dyadic below_a = pair.support_of_a(normal) + Dyadic(pair.a().ball_radius) - dot(normal, of_a);
  const Dyadic below_b = pair.support_of_b(-normal) + Dyadic(pair.b().ball_radius) + dot(normal, of_b);
  if (allowed + Dyadic(off_face_a) < below_a) return "a contact is not on the face of A";
  if (allowed + Dyadic(off_face_b) < below_b) return "a contact is not on the face of B";
  const Dyadic apart = dot(normal, of_b - of_a) - Dyadic(contact.signed_distance);
  if (allowed < apart || apart < -allowed) return "a contact's points are not as far apart as they are said to be";
  if (contact.signed_distance > farthest + tolerance) return "a contact is beyond the margin";
  return {};
}

// `p` is beyond the side from `from` to `to` of a polygon, by more than `tolerance`.
bool is_outside(const DyadicVector& normal, const DyadicVector& from, const DyadicVector& to, const DyadicVector& p,
                const Dyadic& tolerance) {
  const DyadicVector side = to - from;
  const Dyadic turn = dot(normal, checker::cross(side, p - from));
  return !checker::is_at_least(turn, -tolerance, dot(side, side)) && whole::sign(dot(side, side)) > 0;
}

std::string fault_of_polygon(const DyadicVector& normal, const std::vector<Contact>& contacts, const Separation& found,
                             double tolerance, double off_polygon) {
  const std::size_t n = contacts.size();
  if (n < 3) return {};
  const auto at = [&](std::size_t k) { return whole::exactly(contacts[k % n].point_a); };
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 2; j < n; ++j) {
      if (is_outside(normal, at(k), at(k + 1), at(k + j), Dyadic(tolerance)))
        return "the contacts are no convex polygon";
    }
    if (is_outside(normal, at(k), at(k + 1), whole::exactly(found.point_a), Dyadic(tolerance + off_polygon))) {
      return "the nearest points are outside the polygon";
    }
  }
  return {};
}

}  // namespace

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const ContactManifold& claimed, const ManifoldCertificate& certificate,
                                   double margin, double feature_angle) {
  const Separation& found = claimed.separation;
  const CertificateCheck separation = check_certificate(a, b, pose, found, certificate.separation);
  if (!separation.is_proven) return separation;
  const auto failed = [](std::string fault) { return CertificateCheck{false, std::move(fault)}; };
  if (claimed.contacts.empty()) {
    if (found.has_witnesses && !(found.lower > margin)) return failed("bodies within the margin have no contact");
    return {true, {}};
  }
  if (!found.has_witnesses || found.lower > margin) return failed("there are contacts beyond the margin");
  if (certificate.contacts.size() != claimed.contacts.size()) return failed("a contact has no witnesses");
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  const double far = a.reach() + 2.0 * b.reach() + norm_1(pose.a_from_b().translation) + norm_1(found.point_a);
  const double tolerance = promised_accuracy(a, b, found) + kRounding * far;
  const double slope = 2.0 * std::sin(std::fmin(feature_angle, 1.5));
  const DyadicVector normal = whole::exactly(found.normal);
  for (std::size_t k = 0; k < claimed.contacts.size() && fault.empty(); ++k) {
    fault = fault_of_contact(*pair, normal, claimed.contacts[k], certificate.contacts[k], tolerance,
                             slope * 2.0 * a.circumradius(), slope * 2.0 * b.circumradius(),
                             std::fmax(margin, found.upper));
  }
  const double off_polygon = slope * (a.circumradius() + b.circumradius());
  if (fault.empty()) fault = fault_of_polygon(normal, claimed.contacts, found, tolerance, off_polygon);
  return {fault.empty(), std::move(fault)};
}

}  // namespace vex

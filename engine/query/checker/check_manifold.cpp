// The checker of contact manifolds (docs/derivations.md, E25).
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/query/checker/exact_hull.h"
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
                             double off_face_b, double beside, double farthest) {
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
  const Dyadic along = dot(normal, of_b - of_a), apart = along - Dyadic(contact.signed_distance);
  if (allowed < apart || apart < -allowed) return "a contact's points are not as far apart as they are said to be";
  const DyadicVector off = of_b - of_a - DyadicVector{along * normal.x, along * normal.y, along * normal.z};
  const Dyadic most_beside(beside);
  if (most_beside * most_beside < dot(off, off)) return "a contact's points are not opposite each other";
  if (contact.signed_distance > farthest + tolerance) return "a contact is beyond the margin";
  return {};
}

// `p` is beyond the side from `from` to `to` of a polygon, whichever points within `tolerance` of the side's ends are
// meant: its direction is known the less the shorter it is.
bool is_outside(const DyadicVector& normal, const DyadicVector& from, const DyadicVector& to, const DyadicVector& p,
                const Dyadic& tolerance) {
  const DyadicVector side = to - from, off = p - from;
  const Dyadic turn = dot(normal, checker::cross(side, off));
  const Dyadic allowed =
      tolerance * (checker::root_from_above(dot(side, side)) + checker::root_from_above(dot(off, off)));
  return turn + allowed < Dyadic();
}

// Once around it goes up once along an axis and down once, but for sides too short to tell.
bool goes_around_once(const std::vector<Contact>& contacts, const DyadicVector& axis, const Dyadic& tolerance) {
  std::vector<int> ways;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const DyadicVector side =
        whole::exactly(contacts[(k + 1) % contacts.size()].point_a) - whole::exactly(contacts[k].point_a);
    const Dyadic along = dot(axis, side);
    if (tolerance < along) ways.push_back(1);
    if (along < -tolerance) ways.push_back(-1);
  }
  int n_turns = 0;
  for (std::size_t k = 0; k < ways.size(); ++k) n_turns += ways[k] != ways[(k + 1) % ways.size()] ? 1 : 0;
  return n_turns <= 2;
}

// Whether it is as near to the points between two contacts.
bool is_near_edge(const DyadicVector& from, const DyadicVector& to, const DyadicVector& point, const Dyadic& distance) {
  return checker::comes_within({from - point, to - point}, distance);
}

std::string fault_of_polygon(const DyadicVector& normal, const std::vector<Contact>& contacts, const Separation& found,
                             double tolerance, double off_polygon) {
  const std::size_t n = contacts.size();
  const auto at = [&](std::size_t k) { return whole::exactly(contacts[k % n].point_a); };
  const DyadicVector nearest = whole::exactly(found.point_a);
  const Dyadic off(tolerance + off_polygon);
  bool is_near = false;
  for (std::size_t k = 0; k < n && !is_near; ++k) is_near = is_near_edge(at(k), at(k + 1), nearest, off);
  if (n < 3) return is_near ? std::string() : "the nearest points are not between the contacts";
  // Sides across each other: twice the area of the fan, which a polygon that holds a point far from its sides has.
  Dyadic area;
  for (std::size_t k = 1; k + 1 < n; ++k) area = area + dot(normal, checker::cross(at(k) - at(0), at(k + 1) - at(0)));
  if (!is_near && !(off * off < area)) return "the polygon has no area";
  const DyadicVector across_x = checker::cross(normal, {Dyadic(1.0), Dyadic(), Dyadic()}),
                     across_y = checker::cross(normal, {Dyadic(), Dyadic(1.0), Dyadic()}),
                     across_z = checker::cross(normal, {Dyadic(), Dyadic(), Dyadic(1.0)});
  for (const DyadicVector& axis : {across_x, across_y, across_z}) {
    if (!goes_around_once(contacts, axis, Dyadic(tolerance))) return "the polygon goes around more than once";
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 2; j < n; ++j) {
      if (is_outside(normal, at(k), at(k + 1), at(k + j), Dyadic(tolerance)))
        return "the contacts are no convex polygon";
    }
    if (is_outside(normal, at(k), at(k + 1), nearest, off)) {
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
  if (!(margin >= 0.0 && feature_angle >= 0.0)) return failed("the margin or the angle is no number");
  if (claimed.contacts.empty()) {
    if (!(found.lower > margin)) return failed("bodies that may be within the margin have no contact");
    return {true, {}};
  }
  if (!found.has_witnesses || found.lower > margin) return failed("there are contacts beyond the margin");
  if (certificate.contacts.size() != claimed.contacts.size()) return failed("a contact has no witnesses");
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  const double far = a.reach() + 2.0 * b.reach() + norm_1(pose.a_from_b().translation) + norm_1(found.point_a);
  const double tolerance = promised_accuracy(a, b, found) + kRounding * far;
  const double slope = 2.0 * std::sin(std::fmin(feature_angle, 1.5));
  if (!std::isfinite(tolerance + 8.0 * (a.circumradius() + b.circumradius()))) {
    return failed("bodies are so far that no double tells what rounding allows their contacts");
  }
  const DyadicVector normal = whole::exactly(found.normal);
  for (std::size_t k = 0; k < claimed.contacts.size() && fault.empty(); ++k) {
    fault = fault_of_contact(*pair, normal, claimed.contacts[k], certificate.contacts[k], tolerance,
                             slope * 2.0 * a.circumradius(), slope * 2.0 * b.circumradius(),
                             tolerance + slope * 2.0 * (a.circumradius() + b.circumradius()),
                             std::fmax(margin, found.upper));
  }
  const double off_polygon = slope * (a.circumradius() + b.circumradius());
  if (fault.empty()) fault = fault_of_polygon(normal, claimed.contacts, found, tolerance, off_polygon);
  return {fault.empty(), std::move(fault)};
}

}  // namespace vex

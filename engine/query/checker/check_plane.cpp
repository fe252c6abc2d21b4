// The checker of what half-spaces answer (docs/derivations.md, E29).
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/query/checker/contact_statement.h"
#include "engine/query/checker/plane_heights.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using checker::Clear;
using checker::ExactPair;
using checker::ExactPose;
using checker::Heights;
using checker::magnitude;
using checker::times;
using checker::TurningHeights;
using whole::Dyadic;
using whole::DyadicVector;

struct PlaceOfB {
  ExactPose pose;
  double coordinates;  // about the size of all that is rounded
};

// A point of B, told in its own frame and in the half-space's, and what it is over on the plane.
struct ClaimedPoint {
  Vec3d normal, point_a, point_b, own_b;
  double distance;
};
std::string fault_of_point(const HalfSpace& a, const ConvexBody& b, const ExactPair& pair, const Heights& heights,
                           const PlaceOfB& place, const ClaimedPoint& claimed, double near,
                           const std::vector<Witness>& witnesses) {
  for (const Vec3d& v : {claimed.normal, claimed.point_a, claimed.point_b, claimed.own_b}) {
    if (!is_finite(v)) return "a point or the normal is not finite";
  }
  const double own = 1e-12 * b.circumradius() + 16.0 * kUnitRoundoff * (norm_1(claimed.own_b) + b.reach());
  const double far = near + 16.0 * kUnitRoundoff *
                                (place.coordinates + norm_1(claimed.point_a) + norm_1(claimed.point_b) +
                                 std::fabs(a.offset()) + b.reach());
  if (!std::isfinite(own) || !std::isfinite(far)) return "points are so far that no double tells what is allowed them";
  const Dyadic allowed(far), allowed_sq = allowed * allowed;
  const DyadicVector normal = whole::exactly(claimed.normal), across = checker::cross(normal, heights.normal());
  const Dyadic stretch = dot(normal, normal) - Dyadic(1.0), few(0x1p-48);
  if (few < stretch || stretch < -few) return "the normal is no unit vector";
  if (whole::sign(dot(normal, heights.normal())) <= 0 || few * few * heights.normal_sq() < dot(across, across)) {
    return "the normal is not the plane's";
  }
  const DyadicVector point_a = whole::exactly(claimed.point_a), point_b = whole::exactly(claimed.point_b),
                     own_b = whole::exactly(claimed.own_b);
  const Dyadic off_plane = magnitude(dot(heights.normal(), point_a) - heights.offset());
  if (!checker::is_at_least(-off_plane, -allowed, heights.normal_sq())) return "point_a is not on the plane";
  const DyadicVector apart = point_b - point_a - times(Dyadic(claimed.distance), normal);
  if (allowed_sq < dot(apart, apart)) return "the points are not the distance apart along the normal";
  const DyadicVector placed = place.pose(own_b) - point_b;
  if (allowed_sq < dot(placed, placed)) return "point_b is not where point_b_in_b is placed";
  if (!checker::is_near_b(pair.moved(checker::exactly(Transformd{})), witnesses, own_b, Dyadic(own))) {
    return "point_b_in_b is not in B";
  }
  return {};
}

const std::vector<Witness>& first_set(const HalfSpaceCertificate& certificate) {
  static const std::vector<Witness> none;
  return certificate.near_b.empty() ? none : certificate.near_b.front();
}

// What is claimed of a time until which there is no contact.
bool is_clear_before(const TurningHeights& motion, const std::vector<Clear>& clear, double end) {
  double from = 0.0;
  if (clear.empty())
    return motion.is_far_at(Dyadic()) && (end < HUGE_VAL ? motion.is_far_at(Dyadic(end)) : motion.is_far_after(0.0));
  // Heights of the ball are linear in time.
  if (clear.front().from > 0.0 && motion.is_far_at(Dyadic()) && motion.is_far_at(Dyadic(clear.front().from))) {
    from = clear.front().from;
  }
  const bool is_from_first = from == 0.0;
  for (const Clear& interval : clear) {
    if (!(0.0 <= interval.from && interval.from <= from && interval.from < interval.to && interval.to < HUGE_VAL)) {
      return false;
    }
    if (!motion.stays_clear(interval)) return false;
    from = std::fmax(from, interval.to);
  }
  return from >= end || motion.is_far_after(from) || (is_from_first && motion.has_turned_once(from));
}

std::string fault_of_motion(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const ExactPair& pair,
                            const RigidMotion& motion, const FirstContact& claimed,
                            const HalfSpaceCertificate& certificate, double until) {
  if (std::string fault = checker::fault_of_statement(claimed, until); !fault.empty()) return fault;
  const Heights heights(a, pair, pose.a_from_b());
  const Outcome outcome = claimed.verdict.outcome;
  const bool turns = norm_1(motion.angular_velocity) > 0.0, meets = outcome == Outcome::overlap;
  const double end = outcome == Outcome::disjoint ? until : claimed.lower;
  const Dyadic rate = dot(heights.normal(), whole::exactly(motion.velocity));
  if (outcome == Outcome::disjoint || claimed.lower > 0.0) {
    if (heights.sign_of_least({}) <= 0) return "that it is over the plane at first is not proven";
  }
  if (meets && claimed.upper == 0.0) {
    if (heights.sign_of_least({}) > 0) return "that they meet at the start is not proven";
  } else if (turns) {
    const TurningHeights turning(heights, pair, pose.a_from_b(), motion, b.centre());
    if (end > 0.0 && !is_clear_before(turning, certificate.clear, end)) {
      return "not every time before a contact is proven";
    }
    if (meets && !turning.meets(claimed.upper, certificate.lowest)) return "the contact is not proven";
  } else {
    const bool is_for_ever = end == HUGE_VAL;
    const int at_end = is_for_ever ? whole::sign(rate) : heights.sign_of_least({}, Dyadic(end) * rate);
    if (end > 0.0 && (at_end < 0 || (at_end == 0 && outcome == Outcome::disjoint && !is_for_ever))) {
      return "not every time before a contact is proven";
    }
    if (meets && heights.sign_of_least({}, Dyadic(claimed.upper) * rate) > 0) return "the contact is not proven";
  }
  if (!meets) return {};
  const std::optional<ExactPose> then = checker::pose_at(pose.a_from_b(), motion, Dyadic(claimed.time));
  if (!then) return "the contact is beyond what is looked at";
  const double moving = safe_norm(motion.velocity), turning = safe_norm(motion.angular_velocity);
  const double size = norm_1(pose.a_from_b().translation) + b.reach();
  const double waited = (moving + turning * b.reach()) * (claimed.upper - claimed.lower);
  const double accuracy = (b.is_rounded_polytope() ? 1e-12 : 1e-9) * b.circumradius();
  const PlaceOfB place{*then, (size + claimed.time * moving) * (1.0 + claimed.time * turning)};
  const DyadicVector off = whole::exactly(claimed.point_b) - whole::exactly(claimed.point_a);
  const double along = dot(claimed.point_b - claimed.point_a, claimed.normal);
  if (claimed.upper > 0.0) {
    const Dyadic most(waited + accuracy + 16.0 * kUnitRoundoff * (place.coordinates + std::fabs(a.offset())));
    if (most * most < dot(off, off)) return "the points are not one";
  }
  return fault_of_point(a, b, pair, heights, place,
                        {claimed.normal, claimed.point_a, claimed.point_b, claimed.point_b_in_b, along}, accuracy,
                        first_set(certificate));
}

std::optional<ExactPair> over_plane(const ConvexBody& b, const Pose& pose, std::string& fault) {
  return ExactPair::of(ConvexBody(PointBody{}), b, pose.a_from_b(), fault);
}
CertificateCheck check_of(std::string fault) {
  const bool is_proven = fault.empty();
  return {is_proven, std::move(fault)};
}

}  // namespace

CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Separation& claimed,
                                   const HalfSpaceCertificate& certificate) {
  std::string fault;
  const std::optional<ExactPair> pair = over_plane(b, pose, fault);
  if (!pair) return check_of(fault);
  if (!(claimed.lower <= claimed.signed_distance && claimed.signed_distance <= claimed.upper) ||
      !std::isfinite(claimed.signed_distance)) {
    return check_of("the value is not between its bounds");
  }
  const Heights heights(a, *pair, pose.a_from_b());
  const int sign = heights.sign_of_least({});
  const bool is_true = claimed.verdict.outcome == Outcome::undecided ||
                       claimed.verdict.outcome == (sign > 0 ? Outcome::disjoint : Outcome::overlap);
  if (!is_true) return check_of("the verdict is not proven");
  if (claimed.lower > -HUGE_VAL && heights.sign_of_least(Dyadic(claimed.lower)) < 0) {
    return check_of("the lower bound is not proven");
  }
  if (claimed.upper < HUGE_VAL && heights.sign_of_least(Dyadic(claimed.upper)) > 0) {
    return check_of("the upper bound is not proven");
  }
  if (!claimed.has_witnesses) return check_of({});
  const double accuracy = (b.is_rounded_polytope() ? 1e-12 : 1e-9) * b.circumradius() + (claimed.upper - claimed.lower);
  const PlaceOfB place{checker::exactly(pose.a_from_b()), norm_1(pose.a_from_b().translation)};
  return check_of(
      fault_of_point(a, b, *pair, heights, place,
                     {claimed.normal, claimed.point_a, claimed.point_b, claimed.point_b_in_b, claimed.signed_distance},
                     accuracy, first_set(certificate)));
}

CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                                   const FirstContact& claimed, const HalfSpaceCertificate& certificate, double until) {
  std::string fault;
  const std::optional<ExactPair> pair = over_plane(b, pose, fault);
  if (!pair) return check_of(fault);
  if (!is_finite(motion.velocity) || !is_finite(motion.angular_velocity)) return check_of("the motion is not finite");
  return check_of(fault_of_motion(a, b, pose, *pair, motion, claimed, certificate, until));
}

CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                                   const FirstContact& claimed, const HalfSpaceCertificate& certificate, double until) {
  return check_certificate(a, b, pose, RigidMotion{motion, {}}, claimed, certificate, until);
}

CertificateCheck check_certificate(const HalfSpace& a, const ConvexBody& b, const Pose& pose,
                                   std::span<const PlaneContact> claimed, const HalfSpaceCertificate& certificate,
                                   double margin) {
  std::string fault;
  const std::optional<ExactPair> pair = over_plane(b, pose, fault);
  if (!pair) return check_of(fault);
  if (certificate.near_b.size() != claimed.size()) return check_of("a contact has no witnesses");
  const Heights heights(a, *pair, pose.a_from_b());
  const PlaceOfB place{checker::exactly(pose.a_from_b()), norm_1(pose.a_from_b().translation)};
  const double accuracy = (b.is_rounded_polytope() ? 1e-12 : 1e-9) * b.circumradius();
  double deepest = HUGE_VAL;
  for (std::size_t k = 0; k < claimed.size(); ++k) {
    const PlaneContact& contact = claimed[k];
    if (!(contact.signed_distance <= margin)) return check_of("a contact is farther than the margin");
    deepest = std::fmin(deepest, contact.signed_distance);
    const Vec3d own = pose.a_from_b().direction_to_b(contact.point_b - pose.a_from_b().translation);
    fault = fault_of_point(a, b, *pair, heights, place,
                           {a.unit_normal(), contact.point_a, contact.point_b, own, contact.signed_distance}, accuracy,
                           certificate.near_b[k]);
    if (!fault.empty()) return check_of(fault);
  }
  const double allowed = accuracy + 32.0 * kUnitRoundoff * (place.coordinates + std::fabs(a.offset()) + b.reach());
  if (!std::isfinite(allowed)) return check_of("points are so far that no double tells what is allowed them");
  if (heights.sign_of_least(Dyadic(std::fmin(deepest, margin) - allowed)) < 0) {
    return check_of("the body is lower than its contacts");
  }
  return check_of({});
}

}  // namespace vex

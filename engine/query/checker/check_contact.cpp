// The checker of casts and impacts (docs/derivations.md, E25).
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/query/checker/contact_statement.h"
#include "engine/query/checker/exact_hull.h"
#include "engine/query/checker/moving_pair.h"
#include "engine/query/contact_certificate.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using checker::Apart;
using checker::ExactPair;
using checker::Places;
using checker::StraightMotion;
using checker::times;
using checker::TurningMotion;
using whole::Dyadic;
using whole::DyadicVector;

// Of the circumradii: the points of a contact are no farther apart across the normal, where surfaces leave each other
// by less than rounding.
constexpr double kAcross = 1e-8;
// The same: of bodies that overlap at the start, how deep they are in each other along the normal. A contact does not
// tell how near the bounds of that depth are; `penetration_depth` does, and has a certificate of its own.
constexpr double kDepth = 1e-3;

// All but their last time are proven.
bool are_intervals(const std::vector<Apart>& intervals) {
  return std::ranges::all_of(intervals, [](const Apart& x) { return 0.0 <= x.from && x.from < x.to; });
}
// One after the other they leave no time between `from` and `until` out.
bool cover(const std::vector<Apart>& intervals, double from, double until) {
  for (const Apart& interval : intervals) {
    if (!(interval.from <= from)) return false;
    from = std::fmax(from, interval.to);
  }
  return from >= until;
}

// At every time before the claimed contact, or until the end that was asked for, which is looked at.
bool are_apart_before(const TurningMotion& motion, const ContactCertificate& certificate, const FirstContact& claimed,
                      double until) {
  const std::vector<Apart>& apart = certificate.apart;
  const bool is_disjoint = claimed.verdict.outcome == Outcome::disjoint;
  const double end = is_disjoint ? until : claimed.lower;
  if (apart.empty()) return is_disjoint && until == HUGE_VAL ? motion.are_far_after(0.0) : motion.are_far_until(end);
  const double from = apart.front().from > 0.0 && motion.are_far_until(apart.front().from) ? apart.front().from : 0.0;
  const double last = apart.back().to;
  if (!cover(apart, from, std::fmin(last, end))) return false;
  // Of motions that turn a bound is above 0 at the last time of an interval, too.
  return last >= end || motion.are_far_after(last) || (from == 0.0 && motion.has_turned_once(last));
}

bool are_apart_before(const StraightMotion& motion, const ContactCertificate& certificate, const FirstContact& claimed,
                      double until) {
  const std::vector<Apart>& apart = certificate.apart;
  if (claimed.verdict.outcome != Outcome::disjoint) return cover(apart, 0.0, claimed.lower);
  if (!cover(apart, 0.0, until)) return false;
  return until == HUGE_VAL || std::ranges::any_of(apart, [&](const Apart& interval) {
           return until < interval.to || (until == interval.to && motion.is_apart_at(interval, until));
         });
}

// `moving`: how fast any point of a body moves, about.
template <class Motion>
std::string fault_of_touch(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ExactPair& pair,
                           const Motion& motion, double moving, double turning, const FirstContact& claimed,
                           const ContactCertificate& certificate) {
  for (const Vec3d& v : {claimed.normal, claimed.point_a, claimed.point_b, claimed.point_b_in_b}) {
    if (!is_finite(v)) return "a point or the normal is not finite";
  }
  const DyadicVector normal = whole::exactly(claimed.normal), of_a = whole::exactly(claimed.point_a),
                     of_b = whole::exactly(claimed.point_b), own_b = whole::exactly(claimed.point_b_in_b);
  const Dyadic stretch = dot(normal, normal) - Dyadic(1.0), few(0x1p-48);
  if (few < stretch || stretch < -few) return "the normal is no unit vector";
  if (!checker::are_finite(certificate.near_a) || !checker::are_finite(certificate.near_b)) {
    return "a witness is not finite";
  }
  const double size = a.circumradius() + b.circumradius();
  const double accuracy = (pair.are_rounded_polytopes() ? 1e-12 : 1e-9) * size;
  const double coordinates = norm_1(claimed.point_a) + norm_1(claimed.point_b) + a.reach() + 2.0 * b.reach() +
                             norm_1(pose.a_from_b().translation) + claimed.time * moving;
  const double near = accuracy + 16.0 * kUnitRoundoff * coordinates * (1.0 + claimed.time * turning);
  const double own = accuracy + 16.0 * kUnitRoundoff * (norm_1(claimed.point_b_in_b) + b.reach());
  const double waited = 2.0 * (moving + turning * (a.reach() + b.reach())) * (claimed.upper - claimed.lower);
  // An allowance that no double tells would allow everything.
  if (!std::isfinite(near) || !std::isfinite(own) || !std::isfinite(near + waited + kAcross * size)) {
    return "the contact is beyond what is looked at";
  }
  const std::optional<Places> places = motion.places(claimed.time, certificate);
  if (!places) return "the contact is beyond what is looked at";
  const auto are_near = [](std::vector<DyadicVector> points, const DyadicVector& to, const Dyadic& distance) {
    for (DyadicVector& p : points) p = p - to;
    return checker::comes_within(points, distance);
  };
  if (!are_near(places->of_a, of_a, Dyadic(near) + Dyadic(pair.a().ball_radius) - places->margin)) {
    return "point_a is not proven to be near A";
  }
  if (!are_near(places->of_b, of_b, Dyadic(near) + Dyadic(pair.b().ball_radius) - places->margin)) {
    return "point_b is not proven to be near B";
  }
  if (!checker::is_near_b(pair.moved(checker::exactly(Transformd{})), certificate.near_b, own_b, Dyadic(own))) {
    return "point_b_in_b is not in B";
  }
  const DyadicVector off = of_b - of_a;
  const Dyadic along = dot(normal, off), along_allowed(near + waited), allowed(kAcross * size + near + waited);
  const std::optional<Dyadic> gap = motion.gap_at(claimed.time, normal);
  if (!gap) return "the contact is beyond what is looked at";
  const Dyadic touching = *gap - pair.radii();
  if (claimed.upper == 0.0) {
    const Dyadic deep_allowed(kDepth * size + near);
    const DyadicVector beside = off - times(along, normal);
    if (deep_allowed < along - touching || along - touching < -deep_allowed) {
      return "along the normal the bodies are not as deep in each other as the points";
    }
    if (deep_allowed * deep_allowed < dot(beside, beside)) return "the points are not opposite each other";
    return {};
  }
  if (along_allowed < along || along < -along_allowed) return "the points are apart along the normal";
  if (touching < -along_allowed) return "along the normal the bodies do not touch";
  if (allowed * allowed < dot(off, off)) return "the points are not one";
  return {};
}

template <class Motion>
std::string fault_of(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ExactPair& pair,
                     const Motion& motion, double moving, double turning, const FirstContact& claimed,
                     const ContactCertificate& certificate, double until) {
  const Outcome outcome = claimed.verdict.outcome;
  if (std::string fault = checker::fault_of_statement(claimed, until); !fault.empty()) return fault;
  const auto is_proven_at_start = [&](Outcome at_start) {
    return check_certificate(a, b, pose.a_from_b(), at_start, certificate.at_start).is_proven;
  };
  if (outcome == Outcome::overlap && claimed.upper == 0.0 && is_proven_at_start(outcome)) {
    return fault_of_touch(a, b, pose, pair, motion, moving, turning, claimed, certificate);
  }
  if (outcome == Outcome::disjoint && until == 0.0 && is_proven_at_start(outcome)) return {};
  if (outcome == Outcome::disjoint || claimed.lower > 0.0) {
    // B as it stands has its vertices rounded, and where a body turns it has not: what is apart is so in either sense.
    if (turning > 0.0 && !is_proven_at_start(Outcome::disjoint)) return "that they are apart at first is not proven";
    if (!are_intervals(certificate.apart)) return "an interval has no time";
    for (const Apart& interval : certificate.apart) {
      if (!motion.stays_apart(interval))
        return "a direction does not keep the bodies apart for as long as it is said to";
    }
    if (!are_apart_before(motion, certificate, claimed, until)) return "not every time before a contact is proven";
  }
  if (outcome != Outcome::overlap) return {};
  const WitnessHull& hull = certificate.hull;
  if (hull.witnesses.empty() || hull.witnesses.size() != certificate.times.size() ||
      !checker::are_finite(hull.witnesses) || !motion.meets(claimed, certificate)) {
    return "the contact is not proven";
  }
  return fault_of_touch(a, b, pose, pair, motion, moving, turning, claimed, certificate);
}

}  // namespace

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                                   const FirstContact& claimed, const ContactCertificate& certificate, double until) {
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  if (fault.empty() && !is_finite(motion)) fault = "the motion is not finite";
  if (fault.empty())
    fault = fault_of(a, b, pose, *pair, StraightMotion(*pair, {}, motion), safe_norm(motion), 0.0, claimed, certificate,
                     until);
  return {fault.empty(), std::move(fault)};
}

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const RigidMotion& motion, const FirstContact& claimed,
                                   const ContactCertificate& certificate, double until) {
  if (norm_1(motion.angular_velocity) == 0.0) {
    return check_certificate(a, b, pose, motion.velocity, claimed, certificate, until);
  }
  return check_certificate(a, b, pose, RigidMotion{}, motion, claimed, certificate, until);
}

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const FirstContact& claimed, const ContactCertificate& certificate, double until) {
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  for (const RigidMotion* const motion : {&motion_a, &motion_b}) {
    if (fault.empty() && !(is_finite(motion->velocity) && is_finite(motion->angular_velocity))) {
      fault = "a motion is not finite";
    }
  }
  const double moving = safe_norm(motion_a.velocity) + safe_norm(motion_b.velocity);
  if (fault.empty() && norm_1(motion_a.angular_velocity) + norm_1(motion_b.angular_velocity) == 0.0) {
    const StraightMotion straight(*pair, motion_a.velocity, motion_b.velocity);
    fault = fault_of(a, b, pose, *pair, straight, moving, 0.0, claimed, certificate, until);
  } else if (fault.empty()) {
    const TurningMotion turning(*pair, pose.a_from_b(), motion_a, motion_b, a.centre(), b.centre());
    const double spin = safe_norm(motion_a.angular_velocity) + safe_norm(motion_b.angular_velocity);
    fault = fault_of(a, b, pose, *pair, turning, moving, spin, claimed, certificate, until);
  }
  return {fault.empty(), std::move(fault)};
}

CertificateCheck check_ray_certificate(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir,
                                       const FirstContact& claimed, const ContactCertificate& certificate,
                                       double until) {
  Transformd at_origin;
  at_origin.translation = origin;
  return check_certificate(a, ConvexBody(PointBody{}), at_origin, dir, claimed, certificate, until);
}

}  // namespace vex

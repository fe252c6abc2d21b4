// The checker of casts and impacts (docs/derivations.md, E25).
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/query/checker/exact_hull.h"
#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/turning.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/contact_certificate.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;
using whole::DyadicVector;
using Apart = ContactCertificate::Apart;

// Of the circumradii: the points of a contact are no farther apart across the normal, where surfaces leave each other
// by less than rounding.
constexpr double kAcross = 1e-8;
// The same: of bodies that overlap at the start, how deep they are in each other along the normal. A contact does not
// tell how near the bounds of that depth are; `penetration_depth` does, and has a certificate of its own.
constexpr double kDepth = 1e-3;

DyadicVector times(const Dyadic& s, const DyadicVector& v) { return {s * v.x, s * v.y, s * v.z}; }

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

// What both bodies' witnesses mean at a time, each off by less than `margin`.
struct Places {
  std::vector<DyadicVector> of_a, of_b;
  Dyadic margin;
};

// --- a straight motion

class StraightMotion {
 public:
  StraightMotion(const ExactPair& pair, const Vec3d& velocity_a, const Vec3d& velocity_b)
      : pair_(pair), v_a_(whole::exactly(velocity_a)), v_b_(whole::exactly(velocity_b)), motion_(v_b_ - v_a_) {}

  // From `from` on, and until `to`, which is not one of them: the gap along a direction changes at one rate.
  bool stays_apart(const Apart& interval) const {
    if (!checker::is_finite(interval.dir) || !std::isfinite(interval.from) || std::isnan(interval.to)) return false;
    const DyadicVector dir = checker::exactly(interval.dir);
    const Dyadic dir_sq = dot(dir, dir), rate = dot(dir, motion_), radii = pair_.radii();
    if (whole::sign(dir_sq) == 0) return false;
    const Dyadic at_start = pair_.gap_of_cores(dir);
    if (!checker::is_more_than(at_start + Dyadic(interval.from) * rate, radii, dir_sq)) return false;
    if (interval.to == HUGE_VAL) return whole::sign(rate) >= 0;
    return checker::is_at_least(at_start + Dyadic(interval.to) * rate, radii, dir_sq);
  }
  // At that time, too.
  bool is_apart_at(const Apart& interval, double time) const {
    const DyadicVector dir = checker::exactly(interval.dir);
    return checker::is_more_than(pair_.gap_of_cores(dir) + Dyadic(time) * dot(dir, motion_), pair_.radii(),
                                 dot(dir, dir));
  }

  std::optional<Places> places(double time, const ContactCertificate& certificate) const {
    Places places{{}, {}, pair_.margin()};
    for (const Witness& w : certificate.near_a) {
      places.of_a.push_back(pair_.point_of_a(w) + times(Dyadic(time), v_a_));
    }
    for (const Witness& w : certificate.near_b) {
      places.of_b.push_back(pair_.point_of_b(w) + times(Dyadic(time), v_b_));
    }
    return places;
  }

  // Of the cores, times the length of `dir`, from below.
  std::optional<Dyadic> gap_at(double time, const DyadicVector& dir) const {
    return pair_.gap_of_cores(dir) + Dyadic(time) * dot(dir, motion_);
  }

  bool meets(const FirstContact& claimed, const ContactCertificate& certificate) const {
    std::vector<DyadicVector> points;
    for (std::size_t k = 0; k < certificate.times.size(); ++k) {
      const double time = certificate.times[k];
      if (!(claimed.lower <= time && time <= claimed.upper)) return false;
      points.push_back(pair_.core_point(certificate.hull.witnesses[k]) - times(Dyadic(time), motion_));
    }
    return checker::comes_as_near_as(points, certificate.hull.faces, pair_.radii(), pair_.margin(), Dyadic());
  }

 private:
  const ExactPair& pair_;
  DyadicVector v_a_, v_b_, motion_;
};

// --- a motion that turns

// In the frame that A's origin takes along.
class TurningMotion {
 public:
  TurningMotion(const ExactPair& pair, const Transformd& a_from_b, const RigidMotion& motion_a,
                const RigidMotion& motion_b, const Vec3d& centre_a, const Vec3d& centre_b)
      : pair_(pair),
        a_from_b_(a_from_b),
        turn_a_{{}, motion_a.angular_velocity},
        turn_b_{{}, motion_b.angular_velocity},
        a_turns_(norm_1(motion_a.angular_velocity) > 0.0),
        v_a_(whole::exactly(motion_a.velocity)),
        v_(whole::exactly(motion_b.velocity) - v_a_),
        w_a_(whole::exactly(motion_a.angular_velocity)),
        w_b_(whole::exactly(motion_b.angular_velocity)),
        across_a_(a_turns_ ? pair.reach_of_a_across(w_a_, whole::exactly(centre_a)) : Dyadic()),
        across_b_(pair.moved(checker::exactly(a_from_b)).reach_of_b_across(w_b_, whole::exactly(centre_b))) {
    // A ball about A's centre, or about its origin, about which it turns.
    const DyadicVector centre = a_turns_ ? DyadicVector{} : whole::exactly(centre_a);
    from_a_ = whole::exactly(a_from_b.translation) - centre;
    reach_ = pair.reach_of_a_from(centre) + stretch() * pair.reach_of_b() + Dyadic(pair.b().ball_radius);
  }

  bool stays_apart(const Apart& interval) const {
    if (!checker::is_finite(interval.dir) || !std::isfinite(interval.from) || !std::isfinite(interval.to)) return false;
    const DyadicVector n = checker::exactly(interval.dir);
    if (whole::sign(dot(n, n)) == 0) return false;
    const Dyadic from(interval.from), to(interval.to);
    return leans_apart(n, from, to) || comes_no_nearer(n, from, to);
  }

  // Balls about the bodies, B's about the origin of its frame, which moves straight, are apart until then, and from
  // then on.
  bool are_far_until(double time) const {
    const Dyadic t(time), towards = dot(from_a_, v_), v_sq = dot(v_, v_);
    if (!is_far(times(t, v_) + from_a_) || !is_far(from_a_)) return false;
    // The least distance is at one end, or at -towards / v_sq between them.
    if (whole::sign(towards) >= 0 || !(-towards < t * v_sq)) return true;
    const DyadicVector off = checker::cross(from_a_, v_);
    return reach_ * reach_ * v_sq < dot(off, off);
  }
  bool are_far_after(double time) const {
    const DyadicVector at = times(Dyadic(time), v_) + from_a_;
    if (!is_far(at)) return false;
    if (whole::sign(dot(at, v_)) >= 0) return true;
    const DyadicVector off = checker::cross(from_a_, v_);
    return reach_ * reach_ * dot(v_, v_) < dot(off, off);
  }
  // Of one body that only turns: what has not happened in one turn never does, and 2 pi < 6.283185307179588.
  bool has_turned_once(double time) const {
    const Dyadic spin_a = dot(w_a_, w_a_), spin_b = dot(w_b_, w_b_);
    if (whole::sign(spin_a) > 0 && whole::sign(spin_b) > 0) return false;
    const Dyadic turns = Dyadic(time) * Dyadic(time) * (spin_a + spin_b), once(6.283185307179588);
    return whole::sign(dot(v_, v_)) == 0 && !(turns < once * once);
  }

  bool meets(const FirstContact& claimed, const ContactCertificate& certificate) const {
    const std::optional<Place> place = at(Dyadic(claimed.upper));
    if (!place) return false;
    std::vector<DyadicVector> points;
    for (std::size_t k = 0; k < certificate.times.size(); ++k) {
      if (certificate.times[k] != claimed.upper) return false;
      const Witness& witness = certificate.hull.witnesses[k];
      points.push_back(place->pose_a(pair_.point_of_a(witness)) - place->pair.point_of_b(witness));
    }
    return checker::comes_as_near_as(points, certificate.hull.faces, pair_.radii(), margin_at(*place), Dyadic());
  }

  std::optional<Dyadic> gap_at(double time, const DyadicVector& dir) const {
    const std::optional<Place> place = at(Dyadic(time));
    if (!place) return std::nullopt;
    return -(support_of_a(*place, dir) + place->pair.support_of_b(-dir));
  }

  std::optional<Places> places(double time, const ContactCertificate& certificate) const {
    const std::optional<Place> place = at(Dyadic(time));
    if (!place) return std::nullopt;
    const DyadicVector way = times(Dyadic(time), v_a_);
    Places places{{}, {}, margin_at(*place)};
    for (const Witness& w : certificate.near_a) places.of_a.push_back(place->pose_a(pair_.point_of_a(w)) + way);
    for (const Witness& w : certificate.near_b) places.of_b.push_back(place->pair.point_of_b(w) + way);
    return places;
  }

 private:
  struct Place {
    ExactPair pair;  // B where it is
    checker::ExactPose pose_a;
    DyadicVector origin;
  };
  static Dyadic stretch() { return Dyadic(1.0000016); }  // of a rotation to within 1e-6

  std::optional<Place> at(const Dyadic& time) const {
    std::optional<checker::ExactPose> of_b = checker::pose_at(a_from_b_, turn_b_, time);
    std::optional<checker::ExactPose> of_a = checker::pose_at({}, turn_a_, time);
    if (!of_b || !of_a) return std::nullopt;
    of_b->translation = of_b->translation + times(time, v_);
    const DyadicVector origin = of_b->translation;
    return Place{pair_.moved(std::move(*of_b)), std::move(*of_a), origin};
  }
  Dyadic margin_at(const Place& place) const {
    return place.pair.margin() + place.pose_a.error * pair_.reach_of_a_from({});
  }
  Dyadic support_of_a(const Place& place, const DyadicVector& dir) const {
    const Dyadic support = pair_.support_of_a(place.pose_a.direction_to_b(dir));
    if (!a_turns_) return support;
    return support + place.pose_a.error * pair_.reach_of_a_from({}) * checker::root_from_above(dot(dir, dir));
  }

  // E23 with no rounding: about the middle the gap along n is no less than a concave function of time, less a
  // remainder.
  bool leans_apart(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    const Dyadic n_sq = dot(n, n), a_half(1, -1);
    const Dyadic middle = a_half * (from + to), half = a_half * (to - from);
    const std::optional<Place> place = at(middle);
    if (!place) return false;
    const DyadicVector turning_a = checker::cross(n, w_a_), turning_b = checker::cross(n, w_b_);
    const Dyadic bent = checker::root_from_above(dot(turning_a, turning_a)) * across_a_ +
                        checker::root_from_above(dot(turning_b, turning_b)) * across_b_;
    const Dyadic remainder = a_half * half * half * bent;
    const Dyadic rate = dot(n, v_) - dot(turning_b, place->origin);
    for (const Dyadic& time : {-half, half}) {
      const Dyadic gap = time * rate - place->pair.support_of_b(-(n + times(time, turning_b))) -
                         support_of_a(*place, n + times(time, turning_a)) - remainder;
      if (!checker::is_more_than(gap, pair_.radii(), n_sq)) return false;
    }
    return true;
  }

  // Of first order: no point of B moves against n, nor one of A along it, faster than |n x w| |w x y| / |w|.
  bool comes_no_nearer(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    const std::optional<Place> place = at(from);
    if (!place) return false;
    const auto by_turning = [&n](const DyadicVector& w, const Dyadic& across) {
      const DyadicVector turning = checker::cross(n, w);
      if (whole::sign(dot(w, w)) == 0) return Dyadic();
      // The root is from above, so the quotient may be below by as little.
      return Dyadic(1.0 + 0x1p-50) * checker::quotient(checker::root_from_above(dot(turning, turning)) * across,
                                                       checker::root_from_above(dot(w, w)));
    };
    const Dyadic speed = by_turning(w_a_, across_a_) + by_turning(w_b_, across_b_) - dot(n, v_);
    const Dyadic faster = whole::sign(speed) > 0 ? speed : Dyadic();
    const Dyadic gap = -(support_of_a(*place, n) + place->pair.support_of_b(-n));
    return checker::is_more_than(gap - (to - from) * faster, pair_.radii(), dot(n, n));
  }

  bool is_far(const DyadicVector& off) const { return reach_ * reach_ < dot(off, off); }

  const ExactPair& pair_;
  const Transformd& a_from_b_;
  RigidMotion turn_a_, turn_b_;
  bool a_turns_;
  DyadicVector v_a_, v_, w_a_, w_b_, from_a_;
  Dyadic across_a_, across_b_, reach_;
};

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

// What is said, apart from whether it is true.
std::string fault_of_statement(const FirstContact& claimed, double until) {
  const double time = claimed.time, lower = claimed.lower, upper = claimed.upper;
  if (!(until >= 0.0)) return "the end is no time";
  switch (claimed.verdict.outcome) {
    case Outcome::disjoint:
      if (!(time == HUGE_VAL && lower == HUGE_VAL && upper == HUGE_VAL)) return "there is a time of no contact";
      return {};
    case Outcome::overlap:
      if (!(upper < HUGE_VAL)) return "the upper bound is no time";
      if (upper > until) return "the contact is after the end";
      break;
    case Outcome::undecided:
      if (upper != HUGE_VAL) return "an upper bound is claimed and no contact";
      break;
    default: return "the verdict is none";
  }
  if (!(lower >= 0.0 && lower < HUGE_VAL)) return "the lower bound is no time";
  if (!(lower <= time && time <= upper)) return "the time is not between its bounds";
  return {};
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
  const std::optional<Places> places = motion.places(claimed.time, certificate);
  if (!places || !std::isfinite(near)) return "the contact is beyond what is looked at";
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
  const Dyadic own(accuracy + 16.0 * kUnitRoundoff * (norm_1(claimed.point_b_in_b) + b.reach()));
  if (!checker::is_near_b(pair.moved(checker::exactly(Transformd{})), certificate.near_b, own_b, own)) {
    return "point_b_in_b is not in B";
  }
  const double waited = 2.0 * (moving + turning * (a.reach() + b.reach())) * (claimed.upper - claimed.lower);
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
  if (std::string fault = fault_of_statement(claimed, until); !fault.empty()) return fault;
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

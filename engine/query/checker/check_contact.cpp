// The checker of casts and impacts (docs/derivations.md, E25).
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/turning.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/contact_certificate.h"
#include "engine/query/search/point_body.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;
using whole::DyadicVector;
using Apart = ContactCertificate::Apart;

DyadicVector times(const Dyadic& s, const DyadicVector& v) { return {s * v.x, s * v.y, s * v.z}; }

// One after the other they leave no time between `from` and `until` out.
bool cover(const std::vector<Apart>& intervals, double from, double until) {
  for (const Apart& interval : intervals) {
    if (!(interval.from <= from && interval.from <= interval.to)) return false;
    from = std::fmax(from, interval.to);
  }
  return from >= until;
}

// --- a straight motion

class StraightMotion {
 public:
  StraightMotion(const ExactPair& pair, const Vec3d& motion) : pair_(pair), motion_(whole::exactly(motion)) {}

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
  DyadicVector motion_;
};

// --- a motion that turns

class TurningMotion {
 public:
  TurningMotion(const ExactPair& pair, const Transformd& a_from_b, const RigidMotion& motion, const Vec3d& centre_a,
                const Vec3d& centre_b)
      : pair_(pair),
        a_from_b_(a_from_b),
        motion_(motion),
        v_(whole::exactly(motion.velocity)),
        w_(whole::exactly(motion.angular_velocity)),
        across_(pair.moved(checker::exactly(a_from_b)).reach_of_b_across(w_, whole::exactly(centre_b))) {
    const DyadicVector centre = whole::exactly(centre_a);
    from_a_ = whole::exactly(a_from_b.translation) - centre;
    // A rotation to within 1e-6 makes nothing longer than this.
    const Dyadic stretch(1.0000016);
    reach_ = pair.reach_of_a_from(centre) + stretch * pair.reach_of_b() + Dyadic(pair.b().ball_radius);
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
  // Without a velocity what has not happened in one turn never does: 2 pi < 6.2831853071795866.
  bool has_turned_once(double time) const {
    const Dyadic turns = Dyadic(time) * Dyadic(time) * dot(w_, w_), once(6.283185307179588);
    return whole::sign(dot(v_, v_)) == 0 && !(turns < once * once);
  }

  bool meets(const FirstContact& claimed, const ContactCertificate& certificate) const {
    std::optional<checker::ExactPose> pose = checker::pose_at(a_from_b_, motion_, Dyadic(claimed.upper));
    if (!pose) return false;
    for (const double time : certificate.times) {
      if (time != claimed.upper) return false;
    }
    return comes_as_near_as(pair_.moved(std::move(*pose)), certificate.hull, Dyadic());
  }

 private:
  // E23 with no rounding: about the middle the gap along n is no less than a concave function of time, less a
  // remainder.
  bool leans_apart(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    const Dyadic n_sq = dot(n, n), a_half(1, -1);
    const Dyadic middle = a_half * (from + to), half = a_half * (to - from);
    std::optional<checker::ExactPose> pose = checker::pose_at(a_from_b_, motion_, middle);
    if (!pose) return false;
    const DyadicVector origin = pose->translation, turning = checker::cross(n, w_);
    const ExactPair pair = pair_.moved(std::move(*pose));
    const Dyadic of_a = pair.support_of_a(n);
    const Dyadic remainder = a_half * half * half * checker::root_from_above(dot(turning, turning)) * across_;
    for (const Dyadic& time : {-half, half}) {
      const DyadicVector leaning = n + times(time, turning);
      const Dyadic gap = time * (dot(n, v_) - dot(turning, origin)) - pair.support_of_b(-leaning) - of_a - remainder;
      if (!checker::is_more_than(gap, pair.radii(), n_sq)) return false;
    }
    return true;
  }

  // Of first order: no point of B moves against n faster than -n . v + |n x w| |w x y| / |w|.
  bool comes_no_nearer(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    std::optional<checker::ExactPose> pose = checker::pose_at(a_from_b_, motion_, from);
    if (!pose) return false;
    const ExactPair pair = pair_.moved(std::move(*pose));
    const DyadicVector turning = checker::cross(n, w_);
    const Dyadic by_turning = checker::root_from_above(dot(turning, turning)) * across_;
    // The root is from above, so the quotient may be below by as little.
    const Dyadic upwards(1.0 + 0x1p-50), spin = checker::root_from_above(dot(w_, w_));
    const Dyadic speed = upwards * checker::quotient(by_turning, spin) - dot(n, v_);
    const Dyadic faster = whole::sign(speed) > 0 ? speed : Dyadic();
    return checker::is_more_than(pair.gap_of_cores(n) - (to - from) * faster, pair.radii(), dot(n, n));
  }

  bool is_far(const DyadicVector& off) const { return reach_ * reach_ < dot(off, off); }

  const ExactPair& pair_;
  const Transformd& a_from_b_;
  const RigidMotion& motion_;
  DyadicVector v_, w_, from_a_;
  Dyadic across_, reach_;
};

// At every time before the claimed contact, or until the end that was asked for.
bool are_apart_before(const TurningMotion& motion, const ContactCertificate& certificate, const FirstContact& claimed,
                      double until) {
  const std::vector<Apart>& apart = certificate.apart;
  const bool is_for_ever = claimed.verdict.outcome == Outcome::disjoint && until == HUGE_VAL;
  const double end = claimed.verdict.outcome == Outcome::disjoint ? until : claimed.lower;
  if (apart.empty()) return is_for_ever ? motion.are_far_after(0.0) : motion.are_far_until(end);
  const double from = apart.front().from > 0.0 && motion.are_far_until(apart.front().from) ? apart.front().from : 0.0;
  const double last = apart.back().to;
  if (!cover(apart, from, std::fmin(last, end))) return false;
  return last >= end || motion.are_far_after(last) || (from == 0.0 && motion.has_turned_once(last));
}

bool are_apart_before(const StraightMotion& /*motion*/, const ContactCertificate& certificate,
                      const FirstContact& claimed, double until) {
  if (claimed.verdict.outcome != Outcome::disjoint) return cover(certificate.apart, 0.0, claimed.lower);
  return cover(certificate.apart, 0.0, std::nextafter(until, HUGE_VAL));  // the last time is one of them
}

template <class Motion>
std::string fault_of(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Motion& motion,
                     const FirstContact& claimed, const ContactCertificate& certificate, double until) {
  const Outcome outcome = claimed.verdict.outcome;
  if (outcome != Outcome::disjoint) {
    if (!(claimed.lower >= 0.0 && claimed.lower < HUGE_VAL)) return "the lower bound is no time";
    if (!(claimed.lower <= claimed.time && claimed.time <= claimed.upper)) return "the time is not between its bounds";
  }
  if (outcome == Outcome::overlap && claimed.upper == 0.0 &&
      check_certificate(a, b, pose.a_from_b(), outcome, certificate.at_start).is_proven) {
    return {};
  }
  if (outcome == Outcome::disjoint || claimed.lower > 0.0) {
    for (const Apart& interval : certificate.apart) {
      if (!motion.stays_apart(interval))
        return "a direction does not keep the bodies apart for as long as it is said to";
    }
    if (!are_apart_before(motion, certificate, claimed, until)) return "not every time before a contact is proven";
  }
  if (outcome != Outcome::overlap) return {};
  if (!(claimed.upper < HUGE_VAL)) return "the upper bound is no time";
  if (claimed.upper > until) return "the contact is after the end";
  const WitnessHull& hull = certificate.hull;
  if (hull.witnesses.empty() || hull.witnesses.size() != certificate.times.size() ||
      !checker::are_finite(hull.witnesses) || !motion.meets(claimed, certificate)) {
    return "the contact is not proven";
  }
  return {};
}

}  // namespace

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                                   const FirstContact& claimed, const ContactCertificate& certificate, double until) {
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  if (fault.empty() && !is_finite(motion)) fault = "the motion is not finite";
  if (fault.empty()) fault = fault_of(a, b, pose, StraightMotion(*pair, motion), claimed, certificate, until);
  return {fault.empty(), std::move(fault)};
}

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const RigidMotion& motion, const FirstContact& claimed,
                                   const ContactCertificate& certificate, double until) {
  if (norm_1(motion.angular_velocity) == 0.0) {
    return check_certificate(a, b, pose, motion.velocity, claimed, certificate, until);
  }
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  if (fault.empty() && !(is_finite(motion.velocity) && is_finite(motion.angular_velocity))) {
    fault = "the motion is not finite";
  }
  if (fault.empty()) {
    const TurningMotion turning(*pair, pose.a_from_b(), motion, a.centre(), b.centre());
    fault = fault_of(a, b, pose, turning, claimed, certificate, until);
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

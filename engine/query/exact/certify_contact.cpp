// Finds the certificates of casts and impacts. Nothing here is believed: the checker judges what is found.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/numeric/double_double.h"
#include "engine/query/checker/exact_pair.h"
#include "engine/query/contact_certificate.h"
#include "engine/query/exact/exact_witness.h"
#include "engine/query/exact/first_meeting.h"
#include "engine/query/exact/nearest_witnesses.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/exact/recorded_core.h"
#include "engine/query/overlap.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/ray_search.h"
#include "engine/query/search/rigid_sweep.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using whole::DyadicVector;
using Apart = ContactCertificate::Apart;

constexpr int kMostCallsOfContacts = 1 << 11;

// t m in the units of the forms.
Vec3e way(double time, const Vec3d& motion, int exponent) {
  const auto times = [&](double m) {
    const Extended product = Extended(time) * Extended(m);
    return Extended{std::ldexp(product.high, -exponent), std::ldexp(product.low, -exponent)};
  };
  return {times(motion.x), times(motion.y), times(motion.z)};
}

void take(WitnessHull hull, const std::vector<bool>& is_late, double from, double to, ContactCertificate& certificate) {
  certificate.hull = std::move(hull);
  certificate.times.clear();
  for (const bool late : is_late) certificate.times.push_back(late ? to : from);
}

// `own_a`: in A's frame as it is then.
void take_points(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& own_a,
                 const FirstContact& found, ContactCertificate& certificate) {
  certificate.near_a = nearest_of_a(a, own_a, found.normal);
  certificate.near_b = nearest_of_b(b, {}, found.point_b_in_b, pose.a_from_b().direction_to_b(found.normal));
}

/// Straight motions of both bodies: B moves by the difference of the velocities, as A sees it, and `motion_` is that
/// rounded.
class CastCertifier {
 public:
  CastCertifier(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& velocity_a,
                const Vec3d& velocity_b, const FirstContact& found, double until)
      : a_(a),
        b_(b),
        pose_(pose),
        motion_a_{velocity_a, {}},
        motion_b_{velocity_b, {}},
        motion_(velocity_b - velocity_a),
        exact_motion_(is_finite(motion_) ? whole::exactly(velocity_b) - whole::exactly(velocity_a) : DyadicVector{}),
        found_(found),
        until_(until) {}

  ContactCertificate run() {
    const Outcome outcome = found_.verdict.outcome;
    if (outcome == Outcome::overlap) {
      take_points(a_, b_, pose_, found_.point_a - found_.time * motion_a_.velocity, found_, certificate_);
    }
    if (outcome == Outcome::overlap && found_.upper == 0.0) {
      overlap(a_, b_, pose_, &certificate_.at_start);
      return certificate_;
    }
    const std::optional<PlacedForms> placed = placed_forms(a_, b_, pose_.a_from_b());
    if (!placed) return certificate_;
    if (outcome == Outcome::disjoint && until_ == 0.0) overlap(a_, b_, pose_, &certificate_.at_start);
    if (placed->a.is_polytope() && placed->b.is_polytope() && norm_1(motion_) > 0.0) prove_by_programme(*placed);
    if (!is_proven()) prove_by_search(*placed);
    return certificate_;
  }

 private:
  double until() const { return found_.verdict.outcome == Outcome::disjoint ? until_ : found_.lower; }
  bool proves(const FirstContact& found, const ContactCertificate& certificate) const {
    return check_certificate(a_, b_, pose_, motion_a_, motion_b_, found, certificate, until_).is_proven;
  }
  bool is_proven() const { return proves(found_, certificate_); }
  // Whether the directions are enough, whatever proves the contact.
  bool is_apart(const ContactCertificate& certificate) const {
    FirstContact only_apart = found_;
    if (found_.verdict.outcome != Outcome::disjoint) {
      only_apart.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
      only_apart.upper = HUGE_VAL;
    }
    return proves(only_apart, certificate);
  }
  // The velocity, times a power of two.
  std::vector<ExactVector::Part> motion_parts(int exponent) const {
    return {{motion_b_.velocity, exponent}, {-motion_a_.velocity, exponent}};
  }
  // Of a direction along which the bodies part for ever, if it were not for the rounding of `motion_`: the nearest one,
  // nearly, along which they do.
  void bend(ExactVector& dir) const {
    const DyadicVector exact = checker::exactly(dir);
    const whole::Dyadic rate = dot(exact, exact_motion_), speed_sq = dot(exact_motion_, exact_motion_);
    if (whole::sign(rate) >= 0 || whole::sign(speed_sq) == 0) return;
    const int exponent = whole::exponent_of(-rate) - whole::exponent_of(speed_sq) + 2;
    for (const ExactVector::Part& part : motion_parts(exponent)) dir.parts.push_back(part);
  }
  bool offer_apart(std::vector<Apart> apart) {
    ContactCertificate only;
    only.apart = std::move(apart);
    for (Apart& interval : only.apart) {
      if (interval.to == HUGE_VAL) bend(interval.dir);
    }
    if (!is_apart(only)) return false;
    certificate_.apart = std::move(only.apart);
    return true;
  }

  void prove_by_programme(const PlacedForms& placed) {
    FirstMeetingProof proof;
    const FirstMeeting meeting = first_meeting(placed, motion_, &proof);
    if (until() > 0.0) offer_apart({{0.0, until(), exact_vector(proof.dir)}});
    if (!meeting.is_hit) return;
    for (const auto& [i, j] : proof.carriers) {
      for (const double time : {found_.lower, found_.upper}) {
        certificate_.hull.witnesses.push_back(vertex_witness(placed, i, j));
        certificate_.times.push_back(time);
      }
    }
  }

  void prove_by_search(const PlacedForms& placed) {
    const LocalForms forms(placed);
    if (until() > 0.0 && !is_apart(certificate_)) find_apart(forms);
    if (found_.verdict.outcome == Outcome::overlap && found_.upper < HUGE_VAL) find_contact(forms);
  }

  void find_apart(const LocalForms& forms) {
    for (const Vec3d& normal : {found_.normal, searched_normal()}) {
      if (norm_1(normal) > 0.0 && offer_apart({{0.0, until(), {{{normal, 0}}}}})) return;
    }
    // All of B on its way, until it is beyond A: with which the direction of the motion keeps them apart.
    const double speed = safe_norm(motion_);
    const double beyond = 2.0 * ((norm_1(pose_.a_from_b().translation) + a_.reach()) + 2.0 * b_.reach()) / speed;
    const double end = std::fmin(until(), beyond);
    const RecordedCore core(forms, {}, way(end, motion_, forms.exponent()));
    for (const double gap : {0x1p-40, 0x1p-60, 0.0}) {
      const ExactVector dir = prove_nearness(core, searched_normal(), gap, kMostCallsOfContacts).dir;
      if (end == until() ? offer_apart({{0.0, end, dir}})
                         : offer_apart({{0.0, end, dir}, {end, HUGE_VAL, {motion_parts(0)}}}) ||
                               offer_apart({{0.0, HUGE_VAL, dir}})) {
        return;
      }
    }
  }

  Vec3d searched_normal() const {
    const double largest = std::fmax(std::fabs(motion_.x), std::fmax(std::fabs(motion_.y), std::fabs(motion_.z)));
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;  // of bodies at rest it would be INT_MIN
    if (!are_within_range(a_, b_, pose_.a_from_b())) return {};
    const OverlapAnswer start = overlap_answer(a_, b_, pose_);
    RaySearch search(a_, b_, pose_.a_from_b(), times_power_of_two(motion_, -exponent));
    search.run(start.separating_dir, start.verdict.outcome == Outcome::disjoint);
    return search.separating_normal();
  }

  void find_contact(const LocalForms& forms) {
    const RecordedCore core(forms, way(found_.lower, motion_, forms.exponent()),
                            way(found_.upper, motion_, forms.exponent()));
    for (const double gap : {0x1p-50, 0x1p-70, 0.0}) {
      CoreProof proof = prove_nearness(core, found_.normal, gap, kMostCallsOfContacts);
      take(std::move(proof.hull), proof.is_late, found_.lower, found_.upper, certificate_);
      if (is_proven()) return;
      if (proof.surface.faces.empty()) continue;
      take(std::move(proof.surface), proof.is_late_of_surface, found_.lower, found_.upper, certificate_);
      if (is_proven()) return;
    }
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const Pose& pose_;
  RigidMotion motion_a_, motion_b_;
  Vec3d motion_;
  DyadicVector exact_motion_;
  const FirstContact& found_;
  double until_;
  ContactCertificate certificate_;
};

}  // namespace

ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                           const FirstContact& found, double until) {
  return CastCertifier(a, b, pose, {}, motion, found, until).run();
}

ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                           const FirstContact& found, double until) {
  if (norm_1(motion.angular_velocity) == 0.0) return certify(a, b, pose, motion.velocity, found, until);
  return certify(a, b, pose, RigidMotion{}, motion, found, until);
}

ContactCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                           const RigidMotion& motion_b, const FirstContact& found, double until) {
  const Vec3d velocity = motion_b.velocity - motion_a.velocity;
  if (norm_1(motion_a.angular_velocity) + norm_1(motion_b.angular_velocity) == 0.0) {
    const ContactCertificate straight =
        CastCertifier(a, b, pose, motion_a.velocity, motion_b.velocity, found, until).run();
    if (check_certificate(a, b, pose, motion_a, motion_b, found, straight, until).is_proven) return straight;
  }
  ContactCertificate certificate;
  overlap(a, b, pose, &certificate.at_start);
  if (found.verdict.outcome == Outcome::overlap && found.upper == 0.0) {
    take_points(a, b, pose, found.point_a, found, certificate);
    return certificate;
  }
  std::vector<ApartDuring> record;
  time_of_impact(a, b, pose, motion_a, motion_b, until, record);
  for (const ApartDuring& step : record) certificate.apart.push_back({step.from, step.to, {{{step.normal, 0}}}});
  if (found.verdict.outcome != Outcome::overlap || !(found.upper < HUGE_VAL)) return certificate;
  const Transformd a_then = pose_at({}, motion_a, found.time);
  take_points(a, b, pose, a_then.direction_to_b(found.point_a - a_then.translation), found, certificate);
  const RigidSweep sweep(a, b, pose.a_from_b(), {velocity, motion_b.angular_velocity}, motion_a.angular_velocity);
  const std::optional<PlacedForms> placed = placed_forms(a, b, sweep.relative_pose(found.upper));
  if (!placed) return certificate;
  const LocalForms forms(*placed);
  const RecordedCore core(forms);
  FirstContact only_contact = found;  // that nothing is before it costs more to be shown
  only_contact.lower = 0.0;
  for (const double gap : {0x1p-50, 0x1p-70, 0.0}) {
    const CoreProof proof = prove_nearness(core, found.normal, gap, kMostCallsOfContacts);
    for (const WitnessHull* const hull : {&proof.hull, &proof.surface}) {
      if (hull->witnesses.empty()) continue;
      certificate.hull = *hull;
      certificate.times.assign(hull->witnesses.size(), found.upper);
      if (check_certificate(a, b, pose, motion_a, motion_b, only_contact, certificate, until).is_proven) {
        return certificate;
      }
    }
  }
  return certificate;
}

ContactCertificate certify_ray(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir, const FirstContact& found,
                               double until) {
  return certify(a, point_of_ray(), start_of_ray(origin), dir, found, until);
}

}  // namespace vex

// How bodies move, as the checker of casts and impacts takes it: exactly (docs/derivations.md, E25; internal).
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/query/checker/exact_hull.h"
#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/turning.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/contact_certificate.h"

namespace vex::checker {

using whole::Dyadic;
using whole::DyadicVector;
using Apart = ContactCertificate::Apart;

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
    const DyadicVector dir = exactly(interval.dir);
    const Dyadic dir_sq = dot(dir, dir), rate = dot(dir, motion_), radii = pair_.radii();
    if (whole::sign(dir_sq) == 0) return false;
    const Dyadic at_start = pair_.gap_of_cores(dir);
    if (!is_more_than(at_start + Dyadic(interval.from) * rate, radii, dir_sq)) return false;
    if (interval.to == HUGE_VAL) return whole::sign(rate) >= 0;
    return is_at_least(at_start + Dyadic(interval.to) * rate, radii, dir_sq);
  }
  // At that time, too.
  bool is_apart_at(const Apart& interval, double time) const {
    const DyadicVector dir = exactly(interval.dir);
    return is_more_than(pair_.gap_of_cores(dir) + Dyadic(time) * dot(dir, motion_), pair_.radii(), dot(dir, dir));
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
    return comes_as_near_as(points, certificate.hull.faces, pair_.radii(), pair_.margin(), Dyadic());
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
        across_b_(pair.moved(exactly(a_from_b)).reach_of_b_across(w_b_, whole::exactly(centre_b))) {
    // A ball about A's centre, or about its origin, about which it turns.
    const DyadicVector centre = a_turns_ ? DyadicVector{} : whole::exactly(centre_a);
    from_a_ = whole::exactly(a_from_b.translation) - centre;
    reach_ = pair.reach_of_a_from(centre) + stretch() * pair.reach_of_b() + Dyadic(pair.b().ball_radius);
  }

  bool stays_apart(const Apart& interval) const {
    if (!checker::is_finite(interval.dir) || !std::isfinite(interval.from) || !std::isfinite(interval.to)) return false;
    const DyadicVector n = exactly(interval.dir);
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
    const DyadicVector off = cross(from_a_, v_);
    return reach_ * reach_ * v_sq < dot(off, off);
  }
  bool are_far_after(double time) const {
    const DyadicVector at = times(Dyadic(time), v_) + from_a_;
    if (!is_far(at)) return false;
    if (whole::sign(dot(at, v_)) >= 0) return true;
    const DyadicVector off = cross(from_a_, v_);
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
    return comes_as_near_as(points, certificate.hull.faces, pair_.radii(), margin_at(*place), Dyadic());
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
    ExactPose pose_a;
    DyadicVector origin;
  };
  static Dyadic stretch() { return Dyadic(1.0000016); }  // of a rotation to within 1e-6

  std::optional<Place> at(const Dyadic& time) const {
    std::optional<ExactPose> of_b = pose_at(a_from_b_, turn_b_, time);
    std::optional<ExactPose> of_a = pose_at({}, turn_a_, time);
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
    return support + place.pose_a.error * pair_.reach_of_a_from({}) * root_from_above(dot(dir, dir));
  }

  // E23 with no rounding: about the middle the gap along n is no less than a concave function of time, less a
  // remainder.
  bool leans_apart(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    const Dyadic n_sq = dot(n, n), a_half(1, -1);
    const Dyadic middle = a_half * (from + to), half = a_half * (to - from);
    const std::optional<Place> place = at(middle);
    if (!place) return false;
    const DyadicVector turning_a = cross(n, w_a_), turning_b = cross(n, w_b_);
    const Dyadic bent =
        root_from_above(dot(turning_a, turning_a)) * across_a_ + root_from_above(dot(turning_b, turning_b)) * across_b_;
    const Dyadic remainder = a_half * half * half * bent;
    const Dyadic rate = dot(n, v_) - dot(turning_b, place->origin);
    for (const Dyadic& time : {-half, half}) {
      const Dyadic gap = time * rate - place->pair.support_of_b(-(n + times(time, turning_b))) -
                         support_of_a(*place, n + times(time, turning_a)) - remainder;
      if (!is_more_than(gap, pair_.radii(), n_sq)) return false;
    }
    return true;
  }

  // Of first order: no point of B moves against n, nor one of A along it, faster than |n x w| |w x y| / |w|.
  bool comes_no_nearer(const DyadicVector& n, const Dyadic& from, const Dyadic& to) const {
    const std::optional<Place> place = at(from);
    if (!place) return false;
    const auto by_turning = [&n](const DyadicVector& w, const Dyadic& across) {
      const DyadicVector turning = cross(n, w);
      if (whole::sign(dot(w, w)) == 0) return Dyadic();
      // The root is from above, so the quotient may be below by as little.
      return Dyadic(1.0 + 0x1p-50) *
             quotient(root_from_above(dot(turning, turning)) * across, root_from_above(dot(w, w)));
    };
    const Dyadic speed = by_turning(w_a_, across_a_) + by_turning(w_b_, across_b_) - dot(n, v_);
    const Dyadic faster = whole::sign(speed) > 0 ? speed : Dyadic();
    const Dyadic gap = -(support_of_a(*place, n) + place->pair.support_of_b(-n));
    return is_more_than(gap - (to - from) * faster, pair_.radii(), dot(n, n));
  }

  bool is_far(const DyadicVector& off) const { return reach_ * reach_ < dot(off, off); }

  const ExactPair& pair_;
  const Transformd& a_from_b_;
  RigidMotion turn_a_, turn_b_;
  bool a_turns_;
  DyadicVector v_a_, v_, w_a_, w_b_, from_a_;
  Dyadic across_a_, across_b_, reach_;
};

}  // namespace vex::checker

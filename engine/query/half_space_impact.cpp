// A body that turns while it moves, onto a plane: conservative advancement (B. Mirtich, 1996) along the one normal that
// there is (docs/derivations.md, E29).
#include <cmath>
#include <limits>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/query/exact/plane_reach.h"
#include "engine/query/half_space.h"
#include "engine/query/motion_input.h"
#include "engine/query/motion_units.h"
#include "engine/query/search/advance_search.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/plane_sweep.h"

namespace vex {
namespace {

// As of two bodies (advancement.cpp).
constexpr int kMostCallsOfFall = 3 << 11, kMostCallsOfLanding = 1 << 11;
constexpr int kMostLandingTrials = 64, kMostLandingHalvings = 4;
constexpr double kLatestFall = 0x1p480;
// Of times in which the body moves by its size: from it on an advance by exact numbers is looked for, downwards.
constexpr int kLeastExactAdvance = -120;

class Landing {
 public:
  /// Of a body that is not proven to meet the half-space at the start, speeds neither tiny nor huge.
  Landing(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion,
          Outcome at_start, double last, std::vector<ApartDuring>* record)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        motion_(motion),
        sweep_(a, b, a_from_b, motion),
        advances_(sweep_, (b.circumradius() + b.reach()) * a.length()),
        record_(record),
        last_(last),
        touched_(at_start == Outcome::undecided) {}

  FirstContact run() {
    const PlaneSweep::Window window = sweep_.window();
    if (!touched_ && !(window.from <= window.to && window.from <= last_)) return nothing();
    const double until = std::fmin(std::fmin(window.to, last_), kLatestFall);
    const bool ends = until >= last_ || window.to < kLatestFall;
    if (!touched_) time_ = std::fmin(window.from, std::numeric_limits<double>::max());
    while (sweep_.n_support_calls() <= kMostCallsOfFall) {
      if (time_ >= until) return touched_ || !ends ? undecided(UndecidedReason::rounding) : nothing();
      if (touched_ && sweep_.n_support_calls() - n_calls_before_touch_ > kMostCallsOfLanding) {
        return undecided(UndecidedReason::rounding);
      }
      const double gap = sweep_.gap_during(a_.unit_normal(), time_, 0.0);
      if (gap > sweep_.rounding_at(time_)) {
        advance(time_ + advances_.longest(a_.unit_normal(), time_, until, gap));
        continue;
      }
      if (const double clear = touched_ || time_ > 0.0 ? 0.0 : exact_advance(until); clear > 0.0) {
        advance(clear);
        continue;
      }
      if (!touched_) {
        touched_ = true;
        n_calls_before_touch_ = sweep_.n_support_calls();
        lower_ = time_;
      }
      if (finds_contact(until)) return found();
    }
    return undecided(UndecidedReason::iteration_cap);
  }

 private:
  void advance(double to) {
    if (record_ != nullptr && !touched_) record_->push_back({time_, to, a_.unit_normal()});
    time_ = to;
  }

  // A gap that double precision does not see, at the start.
  double exact_advance(double until) const {
    const double speed = sweep_.most_speed(a_.unit_normal());
    const double a_while = std::fmin(until, speed > 0.0 ? b_.reach() * a_.length() / speed : until);
    for (int k = 0; k >= kLeastExactAdvance; k -= 6) {
      double time = std::ldexp(a_while, k);
      if (!is_clear_until(a_, b_, a_from_b_, motion_, time)) continue;
      for (int more = 0; more < 5 && 2.0 * time < a_while; ++more, time *= 2.0) {
        if (!is_clear_until(a_, b_, a_from_b_, motion_, 2.0 * time)) break;
      }
      return time;
    }
    return 0.0;
  }

  // A time of contact, proven, as little after this one as doubling finds it. Where the body is seen to be over the
  // plane again first, the motion goes on from there.
  bool finds_contact(double until) {
    const double speed = sweep_.most_speed(a_.unit_normal()), remaining = until - time_;
    const double a_while = speed > 0.0 ? std::fmin(until, b_.reach() * a_.length() / speed) : until;
    double step = std::fmax(4.0 * sweep_.rounding_at(time_) / speed, 0x1p-50 * std::fmax(time_, 0x1p-10 * a_while));
    for (int k = 0; k < kMostLandingTrials; ++k, step *= 2.0) {
      step = std::fmin(step, remaining);
      if (sweep_.meets_at(time_ + step)) {
        double before = 0.5 * step, after = step;
        for (int h = 0; k > 0 && h < kMostLandingHalvings; ++h) {
          const double middle = 0.5 * (before + after);
          (sweep_.meets_at(time_ + middle) ? after : before) = middle;
        }
        upper_ = time_ + after;
        return true;
      }
      const bool is_over = sweep_.gap_during(a_.unit_normal(), time_ + step, 0.0) > sweep_.rounding_at(time_ + step);
      if (!is_over && step < remaining) continue;
      time_ += step;
      return false;
    }
    time_ = until;
    return false;
  }

  FirstContact counted(FirstContact contact) const {
    contact.n_support_calls = sweep_.n_support_calls();
    return contact;
  }
  FirstContact nothing() const {
    return counted({Verdict::disjoint(DecidedBy::gjk), HUGE_VAL, HUGE_VAL, HUGE_VAL, {}, {}, {}, 0});
  }
  FirstContact undecided(UndecidedReason reason) const {
    const double lower = touched_ ? lower_ : time_;
    return counted({Verdict::undecided(DecidedBy::gjk, reason), lower, lower, HUGE_VAL, {}, {}, {}, 0});
  }
  // The body as it is at `lower`, however much later a contact is proven.
  FirstContact found() const {
    const LeastHeight height = least_height(a_, b_, pose_at(a_from_b_, motion_, lower_));
    FirstContact contact{Verdict::overlap(DecidedBy::gjk), lower_, lower_, upper_, a_.unit_normal(), {}, {}, 0};
    contact.point_b = height.point_b;
    contact.point_b_in_b = height.point_b_in_b;
    contact.point_a = height.point_b - (height.value / a_.length()) * a_.unit_normal();
    return counted(contact);
  }

  const HalfSpace& a_;
  const ConvexBody& b_;
  const Transformd& a_from_b_;
  const RigidMotion& motion_;
  PlaneSweep sweep_;
  AdvanceSearch<PlaneSweep> advances_;
  std::vector<ApartDuring>* record_;
  double last_;  // that is looked at
  bool touched_;
  double time_ = 0.0, lower_ = 0.0, upper_ = HUGE_VAL;
  int n_calls_before_touch_ = 0;
};

FirstContact impact_on_plane(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                             double until, std::vector<ApartDuring>* record) {
  require_end(until);
  if (!is_finite(motion.velocity) || !is_finite(motion.angular_velocity)) {
    throw InputError("a velocity is not finite - give finite numbers");
  }
  const Transformd& pose = a_from_b.a_from_b();
  const bool turns = norm_1(motion.angular_velocity) > 0.0;
  if (!turns && norm_1(motion.velocity) > 0.0) return linear_cast(a, b, a_from_b, motion.velocity, until);
  const LeastHeight height = least_height(a, b, pose);
  const Verdict at_start = plane_verdict(a, b, pose, height);
  FirstContact contact;
  contact.verdict = at_start;
  contact.n_support_calls = 1;
  const bool is_in_range = norm_1(pose.translation) + std::fabs(a.offset()) < 1e150 && std::isfinite(height.error);
  if (at_start.outcome == Outcome::overlap) {
    if (!std::isfinite(height.value) || !is_finite(height.point_b)) return contact;
    contact.normal = a.unit_normal();
    contact.point_b = height.point_b;
    contact.point_b_in_b = height.point_b_in_b;
    contact.point_a = height.point_b - (height.value / a.length()) * a.unit_normal();
    return contact;
  }
  if (!turns || !is_in_range) {
    const bool is_never = at_start.outcome == Outcome::disjoint && !turns;
    if (!is_never) contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
    contact.time = contact.lower = is_never ? HUGE_VAL : 0.0;
    contact.upper = HUGE_VAL;
    return contact;
  }
  const double size = b.reach() + norm_1(pose.translation) + std::fabs(a.offset());
  const int exponent = exponent_of_motion(size, motion, {});
  const RigidMotion scaled = in_units(motion, exponent);
  contact =
      in_own_time(Landing(a, b, pose, scaled, at_start.outcome, scaled_up(until, exponent), record).run(), exponent);
  for (std::size_t k = 0; exponent != 0 && record != nullptr && k < record->size(); ++k) {
    (*record)[k].from = std::ldexp((*record)[k].from, -exponent);
    (*record)[k].to = std::ldexp((*record)[k].to, -exponent);
  }
  const bool is_late = contact.upper > until || !(contact.upper < HUGE_VAL);  // or later than any double
  if (contact.verdict.outcome == Outcome::overlap && (is_late || !is_finite(contact.point_b))) {
    contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
    contact.upper = HUGE_VAL;
    contact.normal = contact.point_a = contact.point_b = contact.point_b_in_b = {};
  }
  return contact;
}

}  // namespace

FirstContact time_of_impact(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                            double until) {
  return impact_on_plane(a, b, a_from_b, motion, until, nullptr);
}

FirstContact time_of_impact(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                            double until, std::vector<ApartDuring>& record) {
  record.clear();
  return impact_on_plane(a, b, a_from_b, motion, until, &record);
}

}  // namespace vex

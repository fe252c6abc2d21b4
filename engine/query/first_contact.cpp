#include "engine/query/first_contact.h"

#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/scaled_bound.h"
#include "engine/query/cast_from_guess.h"
#include "engine/query/exact/exact_cast.h"
#include "engine/query/motion_input.h"
#include "engine/query/overlap.h"
#include "engine/query/search/ray_search.h"
#include "engine/query/separation_with_verdict.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

constexpr double kLeastBalls = 0x1p-10;  // of the circumradii

FirstContact no_contact(Verdict verdict) { return {verdict, HUGE_VAL, HUGE_VAL, HUGE_VAL, {}, {}, {}, 0}; }

FirstContact contact_at_start(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                              const OverlapAnswer& start) {
  std::optional<OverlapAnswer> known = start;
  const Separation found = penetration_depth(a, b, Pose::unchecked(a_from_b), known);
  return {start.verdict,     0.0, 0.0, 0.0, found.normal, found.point_a, found.point_b, found.n_support_calls,
          found.point_b_in_b};
}

// Of what else knows where the bodies meet.
template <class Found>
void take_points(const Found& found, FirstContact& contact) {
  contact.point_a = found.point_a;
  contact.point_b = found.point_b;
  contact.point_b_in_b = found.point_b_in_b;
}

// Of bodies that touch at the start the search finds no plane between them: normal and points are those of the
// distance there, or, where that has none either, along the motion through the points that the search has.
void touch_at_start(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                    const OverlapAnswer& start, const RaySearch::Touch& touch, FirstContact& contact) {
  contact.time = contact.lower;
  std::optional<OverlapAnswer> known = start;
  const Separation found = signed_distance(a, b, Pose::unchecked(a_from_b), known);
  contact.n_support_calls += found.n_support_calls;
  if (found.has_witnesses && norm_1(found.normal) > 0.0) {
    contact.normal = found.normal;
    take_points(found, contact);
    return;
  }
  contact.normal = unit_along(-motion);
  take_points(touch, contact);
}

double between(double lower, double upper) {
  return lower + 0.5 * (std::fmin(upper, std::numeric_limits<double>::max()) - lower);
}

// Where balls touch is told by their centres to all digits, and by a plane across their surface to half of them.
void touch_by_balls(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                    FirstContact& contact) {
  const double radii = a.ball_radius() + b.ball_radius();
  if (!(a.is_rounded_polytope() && b.is_rounded_polytope() && radii > 0.0)) return;
  Transformd pose = a_from_b;
  pose.translation = pose.translation + contact.time * motion;
  // Of balls that are small beside the cores doubles know the centres less well than the balls are large.
  const bool are_large = radii > kLeastBalls * (a.circumradius() + b.circumradius());
  const Separation found =
      are_large ? distance_of_any_sign(a, b, Pose::unchecked(pose)) : signed_distance(a, b, Pose::unchecked(pose));
  contact.n_support_calls += found.n_support_calls;
  if (!(dot(found.normal, motion) < 0.0)) return;
  contact.normal = found.normal;
  take_points(found, contact);
}

// The search along a motion of any length, and what it says of that.
class StraightMotion {
 public:
  StraightMotion(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                 double until)
      : a_(a), b_(b), a_from_b_(a_from_b), motion_(motion), until_(until) {
    search_.look_until(scaled_up(until, exponent_));
  }

  RaySearch& search() { return search_; }
  double at_least(double t) const { return scaled_down(t, -exponent_); }
  double at_most(double t) const { return scaled_up(t, -exponent_); }

  // Nothing where neither a contact is proven nor that there is none.
  std::optional<FirstContact> settled(const RayBounds& bounds) const {
    if (bounds.is_miss) {
      FirstContact none = no_contact(Verdict::disjoint(DecidedBy::gjk));
      none.n_support_calls = search_.n_support_calls();
      return none;
    }
    const double upper = at_most(bounds.upper);
    // A time that overflows is none that could be claimed.
    if (!(bounds.is_hit && upper <= until_ && upper < HUGE_VAL)) return std::nullopt;
    const RaySearch::Touch touch = search_.touch();
    FirstContact contact;
    contact.verdict = Verdict::overlap(DecidedBy::gjk);
    contact.lower = at_least(bounds.lower);
    contact.upper = upper;
    contact.time = between(contact.lower, contact.upper);
    contact.normal = touch.normal;
    contact.n_support_calls = search_.n_support_calls();
    take_points(touch, contact);
    contact.point_b = touch.point_b + contact.time * motion_;
    touch_by_balls(a_, b_, a_from_b_, motion_, contact);
    return contact;
  }

 private:
  const ConvexBody &a_, &b_;
  const Transformd& a_from_b_;
  const Vec3d& motion_;
  double until_;
  int motion_exponent_ =
      std::ilogb(std::fmax(std::fabs(motion_.x), std::fmax(std::fabs(motion_.y), std::fabs(motion_.z))));
  RaySearch search_{a_, b_, a_from_b_, times_power_of_two(motion_, -motion_exponent_)};
  int exponent_ = search_.exponent() + motion_exponent_;  // of the times that are searched for
};

// What the search left open.
void decide_exactly(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                    double latest, double until, FirstContact& contact) {
  const ExactCast exact = cast_exactly(a, b, a_from_b, motion, contact.lower, latest, until);
  contact.n_support_calls += exact.n_support_calls;
  if (exact.outcome == Outcome::undecided) return;
  if (exact.outcome == Outcome::disjoint) {
    const int n_support_calls = contact.n_support_calls;
    contact = no_contact(Verdict::disjoint(DecidedBy::exact));
    contact.n_support_calls = n_support_calls;
    return;
  }
  if (!(exact.upper < HUGE_VAL)) {
    contact.lower = std::fmin(exact.lower, std::numeric_limits<double>::max());
    return;
  }
  contact.verdict = Verdict::overlap(DecidedBy::exact);
  contact.lower = exact.lower;
  contact.upper = exact.upper;
  contact.time = contact.lower;
  // As the bodies stand before they touch; or, where that is no more, as they do.
  Transformd pose = a_from_b;
  pose.translation = pose.translation + contact.lower * motion;
  const Separation apart = signed_distance(a, b, Pose::unchecked(pose));
  contact.n_support_calls += apart.n_support_calls;
  if (dot(apart.normal, motion) < 0.0 || !(norm_1(contact.normal) > 0.0)) contact.normal = apart.normal;
  if (!(norm_1(contact.normal) > 0.0)) contact.normal = unit_along(-motion);
  take_points(apart, contact);
}

}  // namespace

FirstContact linear_cast(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                         double until) {
  const Transformd& a_from_b = pose.a_from_b();
  require_motion(motion, until);
  const OverlapAnswer start = overlap_answer(a, b, pose);
  const Verdict at_start = start.verdict;
  if (at_start.outcome == Outcome::overlap) {
    FirstContact contact = contact_at_start(a, b, a_from_b, start);
    if (!(norm_1(contact.normal) > 0.0)) contact.normal = unit_along(-motion);
    contact.n_support_calls += start.n_support_calls;
    return contact;
  }
  if (!are_within_range(a, b, a_from_b)) {
    const Verdict undecided = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
    return {undecided, 0.0, 0.0, HUGE_VAL, {}, {}, {}, start.n_support_calls};
  }
  StraightMotion moving(a, b, a_from_b, motion, until);
  const RayBounds bounds = moving.search().run(start.separating_dir, at_start.outcome == Outcome::disjoint);
  if (std::optional<FirstContact> contact = moving.settled(bounds)) {
    contact->n_support_calls += start.n_support_calls;
    if (!bounds.is_miss && !(norm_1(contact->normal) > 0.0)) {
      touch_at_start(a, b, a_from_b, motion, start, moving.search().touch(), *contact);
    }
    return *contact;
  }
  FirstContact contact;
  contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
  contact.lower = contact.time = moving.at_least(bounds.lower);
  contact.upper = HUGE_VAL;
  contact.normal = moving.search().touch().normal;
  contact.n_support_calls = start.n_support_calls + moving.search().n_support_calls();
  if (at_start.outcome == Outcome::disjoint) {
    decide_exactly(a, b, a_from_b, motion, moving.at_most(bounds.latest), until, contact);
  }
  return contact;
}

FirstContact linear_cast(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion, double until,
                         const CastGuess& guess) {
  int n_support_calls = 0;
  if (guess.n > 0 && are_within_range(a, b, pose.a_from_b())) {
    require_motion(motion, until);
    StraightMotion moving(a, b, pose.a_from_b(), motion, until);
    const RayBounds bounds = moving.search().run_from(guess);
    if (std::optional<FirstContact> contact = moving.settled(bounds)) return *contact;
    n_support_calls = moving.search().n_support_calls();
  }
  FirstContact contact = linear_cast(a, b, pose, motion, until);
  contact.n_support_calls += n_support_calls;
  return contact;
}

FirstContact cast_ray(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir, double until) {
  return linear_cast(a, point_of_ray(), start_of_ray(origin), dir, until);
}

}  // namespace vex

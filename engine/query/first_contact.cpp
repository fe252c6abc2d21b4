#include "engine/query/first_contact.h"

#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/scaled_bound.h"
#include "engine/query/exact/exact_cast.h"
#include "engine/query/motion_input.h"
#include "engine/query/overlap.h"
#include "engine/query/search/ray_search.h"
#include "engine/query/separation_with_verdict.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

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
  const bool are_balls = a.is_rounded_polytope() && b.is_rounded_polytope() && a.ball_radius() + b.ball_radius() > 0.0;
  if (!are_balls) return;
  Transformd pose = a_from_b;
  pose.translation = pose.translation + contact.time * motion;
  const Separation found = signed_distance(a, b, Pose::unchecked(pose));
  contact.n_support_calls += found.n_support_calls;
  if (!(dot(found.normal, motion) < 0.0)) return;
  contact.normal = found.normal;
  take_points(found, contact);
}

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
  const int motion_exponent =
      std::ilogb(std::fmax(std::fabs(motion.x), std::fmax(std::fabs(motion.y), std::fabs(motion.z))));
  RaySearch search(a, b, a_from_b, times_power_of_two(motion, -motion_exponent));
  search.look_until(scaled_up(until, search.exponent() + motion_exponent));
  const RayBounds bounds = search.run(start.separating_dir, at_start.outcome == Outcome::disjoint);
  const int n_support_calls = start.n_support_calls + search.n_support_calls();
  if (bounds.is_miss) {
    FirstContact none = no_contact(Verdict::disjoint(DecidedBy::gjk));
    none.n_support_calls = n_support_calls;
    return none;
  }
  const int exponent = -(search.exponent() + motion_exponent);
  FirstContact contact;
  contact.n_support_calls = n_support_calls;
  contact.lower = scaled_down(bounds.lower, exponent);
  const RaySearch::Touch touch = search.touch();
  contact.normal = touch.normal;
  const double upper = scaled_up(bounds.upper, exponent);
  // A time that overflows is none that could be claimed.
  if (bounds.is_hit && upper <= until && upper < HUGE_VAL) {
    contact.verdict = Verdict::overlap(DecidedBy::gjk);
    contact.upper = upper;
    contact.time = between(contact.lower, contact.upper);
    take_points(touch, contact);
    contact.point_b = touch.point_b + contact.time * motion;
    touch_by_balls(a, b, a_from_b, motion, contact);
    if (!(norm_1(contact.normal) > 0.0)) touch_at_start(a, b, a_from_b, motion, start, touch, contact);
    return contact;
  }
  contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
  contact.time = contact.lower;
  contact.upper = HUGE_VAL;
  if (at_start.outcome == Outcome::disjoint) {
    decide_exactly(a, b, a_from_b, motion, scaled_up(bounds.latest, exponent), until, contact);
  }
  return contact;
}

FirstContact cast_ray(const ConvexBody& a, const Vec3d& origin, const Vec3d& dir, double until) {
  static const ConvexBody kPoint = PointBody{};
  Transformd a_from_point;
  a_from_point.translation = origin;
  return linear_cast(a, kPoint, a_from_point, dir, until);
}

}  // namespace vex

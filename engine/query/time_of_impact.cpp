#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/scaled_bound.h"
#include "engine/query/first_contact.h"
#include "engine/query/motion_input.h"
#include "engine/query/motion_units.h"
#include "engine/query/overlap.h"
#include "engine/query/search/advancement.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/ray_search.h"
#include "engine/query/separation_with_verdict.h"

namespace vex {
namespace {

// The directions of slower motions are not known to all digits.
constexpr double kLeastSpeed = 0x1p-1000;

// As far as doubles tell it.
RelativeMotion relative_to(const RigidMotion& of_a, const RigidMotion& of_b) {
  const Vec3d velocity = of_b.velocity - of_a.velocity;
  const auto is_exact = [](double x, double y) { return two_sum(x, -y).low == 0.0; };
  return {{velocity, of_b.angular_velocity},
          of_a.angular_velocity,
          is_exact(of_b.velocity.x, of_a.velocity.x) && is_exact(of_b.velocity.y, of_a.velocity.y) &&
              is_exact(of_b.velocity.z, of_a.velocity.z),
          norm_1(of_b.angular_velocity) > 0.0 || norm_1(of_a.angular_velocity) > 0.0};
}

// Points in the frame that A's origin takes along, as A's frame at first has them.
FirstContact in_frame_of_a(FirstContact contact, const RigidMotion& motion_a) {
  if (contact.verdict.outcome != Outcome::overlap || !(norm_1(motion_a.velocity) > 0.0)) return contact;
  const Vec3d way = contact.time * motion_a.velocity;
  contact.point_a = contact.point_a + way;
  contact.point_b = contact.point_b + way;
  if (is_finite(contact.point_a) && is_finite(contact.point_b)) return contact;
  // Points that no double tells are as times that none does.
  FirstContact untold;
  untold.verdict = Verdict::undecided(contact.verdict.by, UndecidedReason::rounding);
  untold.time = untold.lower = contact.lower;
  untold.upper = HUGE_VAL;
  untold.n_support_calls = contact.n_support_calls;
  return untold;
}

FirstContact impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                    const RigidMotion& motion_b, double until, std::vector<ApartDuring>* record) {
  const Transformd& a_from_b = pose.a_from_b();
  for (const RigidMotion* const motion : {&motion_a, &motion_b}) {
    if (is_finite(motion->velocity) && is_finite(motion->angular_velocity)) continue;
    throw InputError("a velocity is not finite - give finite numbers");
  }
  const auto& [motion, spin_of_a, is_exact, turns] = relative_to(motion_a, motion_b);
  if (!is_finite(motion.velocity)) throw InputError("velocities are too far apart - choose another unit of time");
  require_end(until);
  const bool moves = norm_1(motion.velocity) > 0.0;
  if (moves && !turns && is_exact) return in_frame_of_a(linear_cast(a, b, pose, motion.velocity, until), motion_a);
  const OverlapAnswer start = overlap_answer(a, b, pose);
  const Verdict at_start = start.verdict;
  if (at_start.outcome == Outcome::overlap) {
    std::optional<OverlapAnswer> known = start;
    const Separation found = penetration_depth(a, b, pose, known);
    return {at_start,          0.0,           0.0,           0.0,
            found.normal,      found.point_a, found.point_b, found.n_support_calls + start.n_support_calls,
            found.point_b_in_b};
  }
  if (!moves && !turns) {
    const double never = at_start.outcome == Outcome::disjoint ? HUGE_VAL : 0.0;
    return {at_start, never, never, HUGE_VAL, {}, {}, {}, start.n_support_calls};
  }
  if (!are_within_range(a, b, a_from_b)) {
    const Verdict undecided = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
    return {undecided, 0.0, 0.0, HUGE_VAL, {}, {}, {}, start.n_support_calls};
  }
  const double size = a.reach() + b.reach() + norm_1(a_from_b.translation);
  const int exponent = exponent_of_motion(size, motion, spin_of_a);
  const RelativeMotion scaled{in_units(motion, exponent), times_power_of_two(spin_of_a, -exponent), is_exact, turns};
  const bool ends = !moves || norm_1(scaled.of_b.velocity) > kLeastSpeed;
  FirstContact contact = in_own_time(
      advance_to_contact(a, b, a_from_b, scaled, start, ends, scaled_up(until, exponent), record), exponent);
  for (std::size_t k = 0; exponent != 0 && record != nullptr && k < record->size(); ++k) {
    (*record)[k].from = std::ldexp((*record)[k].from, -exponent);
    (*record)[k].to = std::ldexp((*record)[k].to, -exponent);
  }
  const bool is_late = contact.upper > until || !(contact.upper < HUGE_VAL);  // or later than any double
  if (contact.verdict.outcome == Outcome::overlap && is_late) {
    contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
    contact.upper = HUGE_VAL;
  }
  contact.n_support_calls += start.n_support_calls;
  return in_frame_of_a(contact, motion_a);
}

}  // namespace

FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                            double until) {
  return impact(a, b, pose, {}, motion, until, nullptr);
}

FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                            const RigidMotion& motion_b, double until) {
  return impact(a, b, pose, motion_a, motion_b, until, nullptr);
}

FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                            const RigidMotion& motion_b, double until, std::vector<ApartDuring>& record) {
  record.clear();
  return impact(a, b, pose, motion_a, motion_b, until, &record);
}

}  // namespace vex

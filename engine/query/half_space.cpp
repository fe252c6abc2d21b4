#include "engine/query/half_space.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/numeric/errors.h"
#include "engine/numeric/interval.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/whole.h"
#include "engine/query/exact/plane_reach.h"
#include "engine/query/motion_input.h"
#include "engine/query/search/plane_sweep.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using whole::Dyadic;

// No rounding is smaller than that of a number that underflows.
constexpr double kLeastRounding = 0x1p-1060;

Vec3d magnitudes(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

Vec3d on_plane(const HalfSpace& a, const Vec3d& point, double distance) { return point - distance * a.unit_normal(); }

}  // namespace

HalfSpace::HalfSpace(const Vec3d& dir_normal, double offset) : dir_normal_(dir_normal), offset_(offset) {
  if (!is_finite(dir_normal) || !(norm_1(magnitudes(dir_normal)) > 0.0) || !std::isfinite(offset)) {
    throw InputError(
        "the plane of a half-space has a normal that is zero or not finite, or an offset that is not finite - give "
        "finite numbers, and a normal of any length but 0");
  }
  const double largest = larger(std::fabs(dir_normal.x), larger(std::fabs(dir_normal.y), std::fabs(dir_normal.z)));
  const int exponent = std::ilogb(largest);
  dir_normal_ = times_power_of_two(dir_normal, -exponent);
  offset_ = std::ldexp(offset, -exponent);
  const auto is_kept = [exponent](double scaled, double given) { return std::ldexp(scaled, exponent) == given; };
  if (!std::isfinite(offset_) || !is_kept(offset_, offset) || !is_kept(dir_normal_.x, dir_normal.x) ||
      !is_kept(dir_normal_.y, dir_normal.y) || !is_kept(dir_normal_.z, dir_normal.z)) {
    throw InputError(
        "the plane of a half-space has an offset, or parts of its normal, out of the range of doubles beside the "
        "normal's largest part - give a normal of a length near 1");
  }
  length_ = norm(dir_normal_);
  unit_normal_ = {dir_normal_.x / length_, dir_normal_.y / length_, dir_normal_.z / length_};
}

HalfSpace HalfSpace::through(const Vec3d& point, const Vec3d& dir_normal) {
  return {dir_normal, dot(dir_normal, point)};
}

bool detail::are_wide_beside(const ConvexBody& b, const Separation& found) {
  const double promised =
      (b.is_rounded_polytope() ? 1e-12 : 1e-9) * (std::fabs(found.signed_distance) + b.circumradius());
  return !(found.upper - found.lower <= promised);
}

Verdict overlap(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b) {
  return plane_verdict(a, b, a_from_b.a_from_b(), least_height(a, b, a_from_b.a_from_b()));
}

Separation signed_distance(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b) {
  const LeastHeight height = least_height(a, b, a_from_b.a_from_b());
  Separation found;
  found.n_support_calls = 1;
  found.verdict = plane_verdict(a, b, a_from_b.a_from_b(), height);
  const double value = height.value / a.length();
  const double error =
      (height.error + 8.0 * kUnitRoundoff * std::fabs(height.value)) / a.length() * (1.0 + 8.0 * kUnitRoundoff) +
      kLeastRounding;
  if (!std::isfinite(value) || !std::isfinite(error) || !is_finite(height.point_b)) return found;
  found.lower = value - error;
  found.upper = value + error;
  if (found.verdict.outcome == Outcome::disjoint) found.lower = std::fmax(found.lower, 0.0);
  if (found.verdict.outcome == Outcome::overlap) found.upper = std::fmin(found.upper, 0.0);
  found.signed_distance = std::fmax(found.lower, std::fmin(value, found.upper));
  found.is_rough = detail::are_wide_beside(b, found);
  found.has_witnesses = true;
  found.normal = a.unit_normal();
  found.point_b = height.point_b;
  found.point_b_in_b = height.point_b_in_b;
  found.point_a = on_plane(a, height.point_b, found.signed_distance);
  return found;
}

FirstContact linear_cast(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion,
                         double until) {
  require_motion(motion, until);
  const Transformd& pose = a_from_b.a_from_b();
  const LeastHeight height = least_height(a, b, pose);
  FirstContact contact;
  contact.n_support_calls = 1;
  contact.verdict = plane_verdict(a, b, pose, height);
  const auto place = [&](double time) {
    contact.normal = a.unit_normal();
    contact.point_b = height.point_b + time * motion;
    contact.point_b_in_b = height.point_b_in_b;
    contact.point_a = time > 0.0 ? contact.point_b : on_plane(a, contact.point_b, height.value / a.length());
  };
  const auto never = [&] {
    contact.verdict = Verdict::disjoint(contact.verdict.by);
    contact.time = contact.lower = contact.upper = HUGE_VAL;
    return contact;
  };
  const auto open = [&](double lower) {
    contact.verdict = Verdict::undecided(contact.verdict.by, UndecidedReason::rounding);
    contact.time = contact.lower = std::fmin(lower, std::numeric_limits<double>::max());
    contact.upper = HUGE_VAL;
    contact.normal = contact.point_a = contact.point_b = contact.point_b_in_b = {};
    return contact;
  };
  const bool is_in_range = std::isfinite(height.value) && std::isfinite(height.error);
  if (contact.verdict.outcome == Outcome::overlap) {
    if (is_in_range) place(0.0);
    return contact;
  }
  if (contact.verdict.outcome == Outcome::undecided || !is_in_range) return open(0.0);
  const FallingSpeed speed = falling_speed(a, motion);
  if (!(speed.upper > 0.0)) return never();
  contact.lower = std::fmax(next_below(std::fmax(height.lower(), 0.0) / speed.upper), 0.0);
  contact.upper = next_above(height.upper() / speed.lower);
  if (contact.lower > until) return never();
  if (!(contact.upper < HUGE_VAL) && until == HUGE_VAL) return open(contact.lower);
  if (contact.upper > until) {
    // Heights only fall: there is a contact until then exactly if there is one then.
    const Dyadic raised = Dyadic(until) * dot(whole::exactly(a.dir_normal()), whole::exactly(motion));
    const std::optional<bool> meets = meets_plane_exactly(a, b, pose, raised);
    if (!meets) return open(contact.lower);
    contact.verdict = *meets ? Verdict::overlap(DecidedBy::exact) : Verdict::disjoint(DecidedBy::exact);
    if (!*meets) return never();
    contact.upper = until;
  } else {
    contact.verdict = Verdict::overlap(contact.verdict.by);
  }
  const double middle = height.value / (0.5 * speed.lower + 0.5 * speed.upper);
  contact.time = std::fmax(contact.lower, std::fmin(middle, contact.upper));
  place(contact.time);
  if (!is_finite(contact.point_b)) return open(contact.lower);
  return contact;
}

FirstContact cast_ray(const HalfSpace& a, const Vec3d& origin, const Vec3d& dir, double until) {
  if (!is_finite(origin)) throw InputError("a ray's origin is not finite - give finite numbers");
  return linear_cast(a, PointBody{origin}, Pose(), dir, until);
}

}  // namespace vex

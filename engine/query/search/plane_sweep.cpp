#include "engine/query/search/plane_sweep.h"

#include <cmath>
#include <numbers>

#include "engine/numeric/interval.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/whole.h"
#include "engine/query/search/rigid_sweep.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

// No rounding is smaller than that of a number that underflows.
constexpr double kLeastRounding = 0x1p-1060;
constexpr double kRoundedUp = 1.0 + 0x1p-40;  // more than any dozen of roundings

Vec3d magnitudes(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
Transformd without_translation(Transformd pose) {
  pose.translation = {};
  return pose;
}

}  // namespace

// E29. The ball about the core's points stays one whatever R is, so that it is added here.
LeastHeight least_height(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b) {
  const Vec3d& n = a.dir_normal();
  const Vec3d dir_b = a_from_b.direction_to_b(-n);
  const Vec3d core_b = b.core_support(dir_b), core = a_from_b(core_b);
  const double radius = b.ball_radius(), drop = radius * a.length();
  const double size =
      norm_1(n) * b.reach() + dot(magnitudes(n), magnitudes(a_from_b.translation)) + std::fabs(a.offset()) + drop;
  LeastHeight found{
      (dot(n, core) - a.offset()) - drop,
      b.core_support_error() * a.length() * (1.0 + 0x1p-18) + 40.0 * kUnitRoundoff * size + kLeastRounding, core,
      core_b};
  if (radius > 0.0) {
    found.point_b = core - radius * a.unit_normal();
    found.point_b_in_b = core_b + ball_support(radius, dir_b);
  }
  return found;
}

FallingSpeed falling_speed(const HalfSpace& a, const Vec3d& motion) {
  const double speed = -dot(a.dir_normal(), motion);
  const double error = 4.0 * kUnitRoundoff * dot(magnitudes(a.dir_normal()), magnitudes(motion)) + kLeastRounding;
  if (std::fabs(speed) > 2.0 * error && std::isfinite(speed)) return {speed - error, speed + error};
  const whole::Dyadic exact = -dot(whole::exactly(a.dir_normal()), whole::exactly(motion));
  if (sign(exact) == 0) return {0.0, 0.0};
  const int exponent = whole::exponent_of(exact);
  const double rounded = std::ldexp(whole::rounded(exact, exponent).high, exponent);
  return sign(exact) > 0 ? FallingSpeed{std::fmax(next_below(rounded), 0.0), next_above(rounded)}
                         : FallingSpeed{next_below(rounded), std::fmin(next_above(rounded), 0.0)};
}

PlaneSweep::PlaneSweep(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion)
    : a_(a),
      b_(b),
      a_from_b_(a_from_b),
      motion_(motion),
      dir_turning_(cross(a.dir_normal(), motion.angular_velocity)),
      spin_(safe_norm(motion.angular_velocity) * kRoundedUp),
      turning_((safe_norm(dir_turning_) + 8.0 * kUnitRoundoff * a.length() * spin_) * kRoundedUp + kLeastRounding),
      height_at_first_(dot(a.dir_normal(), a_from_b.translation) - a.offset()),
      along_(dot(magnitudes(a.dir_normal()), magnitudes(a_from_b.translation)) + std::fabs(a.offset())),
      along_v_(dot(magnitudes(a.dir_normal()), magnitudes(motion.velocity))),
      drop_(b.ball_radius() * a.length()) {
  const CoreReach reach = core_reach(b, without_translation(a_from_b), motion.angular_velocity);
  from_origin_ = reach.from_origin;
  from_axis_ = reach.from_axis;
}

double PlaneSweep::fall_by_bending(double time) const {
  return 0.5 * ((time * spin_) * (time * turning_)) * from_axis_ * kRoundedUp + kLeastRounding;
}

double PlaneSweep::most_speed(const Vec3d& /*unit_normal*/) const {
  const double falling = std::fmax(0.0, falling_speed(a_, motion_.velocity).upper);
  return (falling + turning_ * from_axis_) * kRoundedUp;
}

// E29, for every place that B has until then, in units of the normal that leans: of what it is made of, of the turn as
// `pose_at` computes it, and of what underflows.
double PlaneSweep::error_until(double time, double leaning_by) const {
  const double leaning = norm_1(a_.dir_normal()) + leaning_by, core = leaning * from_origin_;
  const double made_of = 2.0 * core + along_ + time * along_v_ + drop_;
  const double turned = ((16.0 * time * spin_ + 48.0) * leaning + 16.0 * leaning_by) * from_origin_;
  return b_.core_support_error() * leaning * (1.0 + 0x1p-18) + kUnitRoundoff * (40.0 * made_of + turned) +
         kLeastRounding * (1.0 + time) * (1.0 + from_origin_);
}

double PlaneSweep::rounding_at(double time) const { return error_until(time, 0.0); }

double PlaneSweep::gap_during(const Vec3d& /*unit_normal*/, double from, double duration) {
  const double until = (from + duration) * (1.0 + 4.0 * kUnitRoundoff), middle = from + 0.5 * duration;
  // The middle and the ends are rounded.
  const double half = 0.5 * duration + (duration > 0.0 ? 4.0 * kUnitRoundoff * until : 0.0);
  const Transformd turn = pose_at(without_translation(a_from_b_), {{}, motion_.angular_velocity}, middle);
  const double rate = dot(a_.dir_normal(), motion_.velocity);
  double least = HUGE_VAL;
  for (const double time : {-half, half}) {
    const Vec3d leaning = a_.dir_normal() + time * dir_turning_;
    const Vec3d lowest = turn(b_.core_support(-turn.direction_to_b(leaning)));
    ++n_support_calls_;
    least = lesser(least, ((height_at_first_ + middle * rate) + time * rate) + dot(leaning, lowest));
    if (half == 0.0) break;
  }
  const double leaning_by = 1.8 * half * turning_;  // norm_1 is no more than root 3 times the length
  return (least - drop_) - fall_by_bending(half) - error_until(until, leaning_by);
}

bool PlaneSweep::meets_at(double time) {
  const Transformd turn = pose_at(without_translation(a_from_b_), {{}, motion_.angular_velocity}, time);
  const Vec3d lowest = turn(b_.core_support(turn.direction_to_b(-a_.dir_normal())));
  ++n_support_calls_;
  const double origin = height_at_first_ + time * dot(a_.dir_normal(), motion_.velocity);
  return (origin + dot(a_.dir_normal(), lowest)) - drop_ + error_until(time, 0.0) <= 0.0;
}

PlaneSweep::Window PlaneSweep::window() const {
  const double reach = (a_.length() * from_origin_ + drop_) * kRoundedUp + kLeastRounding;
  const double error = 8.0 * kUnitRoundoff * along_ + kLeastRounding;
  const double above = (height_at_first_ - reach) - error;  // of the ball's lowest point, from below
  const FallingSpeed speed = falling_speed(a_, motion_.velocity);
  if (speed.upper > 0.0) {
    return {std::fmax(0.0, above / speed.upper * (1.0 - 8.0 * kUnitRoundoff)), HUGE_VAL};
  }
  if (above > 0.0) return {1.0, 0.0};
  if (speed.lower < 0.0) {
    return {0.0, speed.upper < 0.0 ? next_above(above / speed.upper) * kRoundedUp : HUGE_VAL};
  }
  return {0.0, next_above(2.0 * std::numbers::pi / safe_norm(motion_.angular_velocity)) * kRoundedUp};
}

}  // namespace vex

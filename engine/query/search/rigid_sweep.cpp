#include "engine/query/search/rigid_sweep.h"

#include <array>
#include <cmath>
#include <numbers>

#include "engine/numeric/rounding.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

constexpr double kUp = 1.0 + 0x1p-40;  // more than any dozen of roundings

// More than what is lost of three coordinates where they are subnormal.
constexpr double kSubnormal = 0x1p-1072;

// Of any length but 0, to a few roundings.
Vec3d unit(const Vec3d& a) {
  const Vec3d dir = scaled_to_unit_exponent(a);
  const double length = norm(dir);
  return {dir.x / length, dir.y / length, dir.z / length};
}

}  // namespace

// Rodrigues: exp([x]) = I + sin(angle) [k] + (1 - cos(angle)) [k]^2, x = angle * k.
Transformd pose_at(const Transformd& a_from_b, const RigidMotion& motion, double time) {
  Transformd pose = a_from_b;
  pose.translation = a_from_b.translation + time * motion.velocity;
  const Vec3d& w = motion.angular_velocity;
  if (!(norm_1(w) > 0.0)) return pose;
  const Vec3d k = unit(w);
  // The length of a subnormal vector has few digits.
  const int exponent = std::ilogb(std::fmax(std::fabs(w.x), std::fmax(std::fabs(w.y), std::fabs(w.z))));
  const double angle = std::ldexp(time, exponent) * norm(times_power_of_two(w, -exponent));
  const double sine = std::sin(angle), half = std::sin(0.5 * angle), versine = 2.0 * half * half;
  const auto turned = [&](const Vec3d& x) {
    const Vec3d across = cross(k, x);
    return x + (sine * across + versine * cross(k, across));
  };
  const Vec3d column_x = turned({a_from_b.row_x.x, a_from_b.row_y.x, a_from_b.row_z.x});
  const Vec3d column_y = turned({a_from_b.row_x.y, a_from_b.row_y.y, a_from_b.row_z.y});
  const Vec3d column_z = turned({a_from_b.row_x.z, a_from_b.row_y.z, a_from_b.row_z.z});
  pose.row_x = {column_x.x, column_y.x, column_z.x};
  pose.row_y = {column_x.y, column_y.y, column_z.y};
  pose.row_z = {column_x.z, column_y.z, column_z.z};
  return pose;
}

RigidSweep::RigidSweep(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion)
    : a_(a),
      b_(b),
      a_from_b_(a_from_b),
      motion_(motion),
      spin_(safe_norm(motion.angular_velocity) * kUp),
      speed_1_(norm_1(motion.velocity) * kUp) {
  // The core lies in the ball about the centre that is smaller than B's by the radius of its own.
  const double core = (b.circumradius() - b.ball_radius()) + 8.0 * kUnitRoundoff * b.circumradius();
  const Vec3d centre = b.centre();
  from_origin_ = std::fmax(0.0, safe_norm(centre) + core) * (1.0 + 2e-6);
  from_axis_ = from_origin_;
  if (spin_ > 0.0) {
    Transformd turn = a_from_b;
    turn.translation = {};
    const Vec3d axis = unit(motion.angular_velocity);
    const double off_axis = safe_norm(cross(axis, turn(centre))) + 16.0 * kUnitRoundoff * norm_1(centre);
    from_axis_ = std::fmin(from_origin_, std::fmax(0.0, off_axis * kUp + core) * (1.0 + 2e-6));
  }
}

// E23: what pose_at may be off by, at a point of B's core.
double RigidSweep::pose_error(double time) const {
  const double lost = time * kSubnormal * (1.0 + from_origin_);
  return kUnitRoundoff *
             ((8.0 * time * spin_ + 48.0) * from_origin_ + 4.0 * (norm_1(a_from_b_.translation) + time * speed_1_)) +
         lost;
}

// E1, for every place that B has until then.
double RigidSweep::support_error(double time) const {
  const double reach = a_.reach() + 2.0 * b_.reach() + norm_1(a_from_b_.translation) + time * speed_1_;
  return a_.core_support_error() + 2.0 * b_.core_support_error() + 48.0 * kUnitRoundoff * reach;
}

double RigidSweep::rounding_at(double time) const { return 2.0 * support_error(time) + pose_error(time); }

double RigidSweep::most_speed(const Vec3d& unit_normal) const {
  const double turning = safe_norm(cross(unit_normal, motion_.angular_velocity)) + 8.0 * kUnitRoundoff * spin_;
  return (std::fmax(0.0, -dot(unit_normal, motion_.velocity)) + 8.0 * kUnitRoundoff * speed_1_ + turning * from_axis_) *
             kUp +
         kSubnormal * (1.0 + from_origin_);
}

double RigidSweep::gap_during(const Vec3d& unit_normal, double from, double duration) {
  const double until = (from + duration) * (1.0 + 4.0 * kUnitRoundoff);
  const double middle = from + 0.5 * duration;
  // The middle and the ends are rounded.
  const double half = 0.5 * duration + (duration > 0.0 ? 4.0 * kUnitRoundoff * until : 0.0);
  Transformd turn = pose(middle);
  const Vec3d origin = turn.translation;
  turn.translation = {};
  if (n_support_calls_ == 0 || norm_1(last_normal_ - unit_normal) > 0.0) {
    last_normal_ = unit_normal;
    last_of_a_ = a_.core_support(unit_normal);
    ++n_support_calls_;
  }
  const Vec3d turning = cross(unit_normal, motion_.angular_velocity);
  // The part of n across the axis turns with it: |n x w| / |w|.
  const double across = (safe_norm(turning) + 8.0 * kUnitRoundoff * spin_) * spin_;
  double least = HUGE_VAL, longest = 0.0;
  for (const double time : {-half, half}) {
    const Vec3d leaning = unit_normal + time * turning;
    const Vec3d of_b = turn(b_.core_support(-turn.direction_to_b(leaning)));
    ++n_support_calls_;
    const double apart = dot(unit_normal, (origin + time * motion_.velocity) - last_of_a_) + dot(leaning, of_b);
    least = std::fmin(least, apart);
    longest = std::fmax(longest, norm_1(leaning));
    if (half == 0.0) break;
  }
  const double remainder = 0.5 * half * half * across * from_axis_ * kUp;
  const double balls = (a_.ball_radius() + b_.ball_radius()) * (1.0 + gamma(8));
  return least - balls - remainder - support_error(until) * longest - pose_error(until);
}

// K holds the points of a tetrahedron about the origin, and with it the ball in the tetrahedron, a third as large.
bool RigidSweep::meets_at(double time) {
  const Transformd pose = this->pose(time);
  const double reach = a_.reach() + 2.0 * b_.reach() + norm_1(pose.translation);
  // Vertices of polytopes are rounded as they are placed, and so are the places of the corners.
  const double radius = pose_error(time) + 16.0 * kUnitRoundoff * reach;
  const double corner = 3.25 / std::numbers::sqrt3 * radius;
  constexpr std::array<Vec3d, 4> kCorners = {
      {{1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}}};
  for (const Vec3d& to : kCorners) {
    Transformd moved = pose;
    moved.translation = pose.translation + corner * to;
    const OverlapAnswer answer = overlap_answer(a_, b_, Pose::unchecked(moved));
    n_support_calls_ += answer.n_support_calls;
    if (answer.verdict.outcome != Outcome::overlap) return false;
  }
  return true;
}

RigidSweep::Window RigidSweep::window() const {
  const Vec3d from_a = a_from_b_.translation - a_.centre();
  const double rounding = 32.0 * kUnitRoundoff * (norm_1(a_from_b_.translation) + norm_1(a_.centre()));
  const double radii = (a_.circumradius() + b_.ball_radius() + from_origin_) * (1.0 + 32.0 * kUnitRoundoff) + rounding;
  const double speed = safe_norm(motion_.velocity);
  if (!(speed > 0.0)) {
    const double turn = 2.0 * std::numbers::pi / spin_ * kUp;
    return safe_norm(from_a) > radii ? Window{1.0, 0.0} : Window{0.0, turn * kUp};
  }
  const Vec3d along = unit(motion_.velocity);
  const double least = safe_norm(cross(from_a, along));
  if (least > radii) return {1.0, 0.0};
  const double at_least = -dot(from_a, along);
  const double half = std::sqrt(radii - least) * std::sqrt(radii + least) * kUp + rounding;
  const Window window{((at_least - half) - rounding) / speed, ((at_least + half) + rounding) / speed};
  const double from = window.from - 8.0 * kUnitRoundoff * std::fabs(window.from);
  return {std::fmax(0.0, from), window.to + 8.0 * kUnitRoundoff * std::fabs(window.to)};
}

}  // namespace vex

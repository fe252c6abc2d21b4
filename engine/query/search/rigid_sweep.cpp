#include "engine/query/search/rigid_sweep.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/numeric/rounding.h"
#include "engine/query/overlap.h"
#include "engine/query/search/overlap_filter.h"

namespace vex {
namespace {

constexpr double kUp = 1.0 + 0x1p-40;  // more than any dozen of roundings

// Of each search for one of the shifts that prove a contact. Where it takes more a later time is proven sooner, and the
// exact forms are not worth it for the same reason.
constexpr int kMostCallsOfContact = 64;

// Trials of how long bodies stay apart from the start on; and of the lengths that are looked at then.
constexpr int kMostTrialsAtStart = 8, kLargestExponentAtStart = 400;

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
Spin::Spin(const Vec3d& w) {
  if (!(norm_1(w) > 0.0)) return;
  turns = true;
  axis = unit(w);
  // The length of a subnormal vector has few digits.
  exponent = std::ilogb(std::fmax(std::fabs(w.x), std::fmax(std::fabs(w.y), std::fabs(w.z))));
  speed = norm(times_power_of_two(w, -exponent));
}

namespace {

Transformd pose_at(const Transformd& a_from_b, const Vec3d& velocity, const Spin& spin, double time) {
  Transformd pose = a_from_b;
  pose.translation = a_from_b.translation + time * velocity;
  if (!spin.turns) return pose;
  const Vec3d& k = spin.axis;
  const double angle = times_power_of_two(Vec3d{time, 0.0, 0.0}, spin.exponent).x * spin.speed;
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

}  // namespace

Transformd pose_at(const Transformd& a_from_b, const RigidMotion& motion, double time) {
  return pose_at(a_from_b, motion.velocity, Spin(motion.angular_velocity), time);
}

// The core lies in the ball about the centre that is smaller than the body's by the radius of its own.
CoreReach core_reach(const ConvexBody& body, const Transformd& turn, const Vec3d& angular_velocity) {
  const double core = (body.circumradius() - body.ball_radius()) + 8.0 * kUnitRoundoff * body.circumradius();
  const Vec3d centre = body.centre();
  const double from_origin = std::fmax(0.0, safe_norm(centre) + core) * (1.0 + 2e-6);
  if (!(norm_1(angular_velocity) > 0.0)) return {from_origin, from_origin};
  const double off_axis =
      safe_norm(cross(unit(angular_velocity), turn(centre))) + 16.0 * kUnitRoundoff * norm_1(centre);
  return {from_origin, std::fmin(from_origin, std::fmax(0.0, off_axis * kUp + core) * (1.0 + 2e-6))};
}

RigidSweep::RigidSweep(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion,
                       const Vec3d& spin_of_a, bool is_exact)
    : a_(a),
      b_(b),
      a_from_b_(a_from_b),
      motion_(motion),
      turning_(motion.angular_velocity),
      spin_(safe_norm(motion.angular_velocity) * kUp),
      speed_1_(norm_1(motion.velocity) * kUp),
      velocity_error_(is_exact ? 0.0 : 2.0 * kUnitRoundoff),
      motion_of_a_{{}, spin_of_a},
      turning_of_a_(spin_of_a),
      spin_of_a_(safe_norm(spin_of_a) * kUp),
      at_first_(norm_1(a_from_b.translation)),
      reach_(a.reach() + 2.0 * b.reach() + at_first_),
      own_error_(a.core_support_error() + 2.0 * b.core_support_error()),
      balls_((a.ball_radius() + b.ball_radius()) * (1.0 + gamma(8))) {
  Transformd turn = a_from_b;
  turn.translation = {};
  const CoreReach of_b = core_reach(b, turn, motion.angular_velocity);
  from_origin_ = of_b.from_origin;
  from_axis_ = of_b.from_axis;
  if (!a_turns()) return;
  const CoreReach of_a = core_reach(a, {}, spin_of_a);
  from_origin_a_ = of_a.from_origin;
  from_axis_a_ = of_a.from_axis;
}

Transformd RigidSweep::turn_of_a(double time) const { return pose_at({}, {}, turning_of_a_, time); }

Vec3d RigidSweep::turned_with_a(double time, const Vec3d& vector) const {
  return a_turns() ? turn_of_a(time)(vector) : vector;
}
Vec3d RigidSweep::turned_back(double time, const Vec3d& vector) const {
  return a_turns() ? turn_of_a(time).direction_to_b(vector) : vector;
}

Transformd RigidSweep::relative_pose(double time) const {
  const Transformd of_b = pose_at(a_from_b_, motion_.velocity, turning_, time);
  if (!a_turns()) return of_b;
  const Transformd of_a = turn_of_a(time);
  const auto column = [&](double x, double y, double z) { return of_a.direction_to_b({x, y, z}); };
  const Vec3d x = column(of_b.row_x.x, of_b.row_y.x, of_b.row_z.x),
              y = column(of_b.row_x.y, of_b.row_y.y, of_b.row_z.y),
              z = column(of_b.row_x.z, of_b.row_y.z, of_b.row_z.z);
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, of_a.direction_to_b(of_b.translation)};
}

Vec3d RigidSweep::between_centres(double time) const {
  return pose_at(a_from_b_, motion_.velocity, turning_, time)(b_.centre()) - turned_with_a(time, a_.centre());
}

// E23: what pose_at may be off by, at a point of B's core.
double RigidSweep::pose_error(double time) const {
  const double lost = time * kSubnormal * (1.0 + from_origin_ + from_origin_a_);
  const double way = at_first_ + time * speed_1_;
  double error = kUnitRoundoff * ((8.0 * time * spin_ + 48.0) * from_origin_ + 4.0 * way) + lost;
  // Turned back with A, and A's own points.
  if (a_turns()) {
    const double turn_of_a = 8.0 * time * spin_of_a_ + 48.0;
    error += kUnitRoundoff * ((turn_of_a + 8.0) * (from_origin_ + way) + turn_of_a * from_origin_a_);
  }
  return error;
}

// E1, for every place that B has until then.
double RigidSweep::support_error(double time) const {
  return own_error_ + 48.0 * kUnitRoundoff * (reach_ + time * speed_1_);
}

double RigidSweep::rounding_at(double time) const { return 2.0 * support_error(time) + pose_error(time); }

double RigidSweep::most_speed(const Vec3d& unit_normal) const {
  const double turning = safe_norm(cross(unit_normal, motion_.angular_velocity)) + 8.0 * kUnitRoundoff * spin_;
  const double straight = std::fmax(0.0, -dot(unit_normal, motion_.velocity)) + 8.0 * kUnitRoundoff * speed_1_;
  double of_a = 0.0;
  if (a_turns()) {
    of_a = (safe_norm(cross(unit_normal, motion_of_a_.angular_velocity)) + 8.0 * kUnitRoundoff * spin_of_a_) *
           from_axis_a_;
  }
  return (straight + turning * from_axis_ + of_a) * kUp + kSubnormal * (1.0 + from_origin_ + from_origin_a_);
}

void RigidSweep::look_along(const Vec3d& unit_normal) {
  last_normal_ = unit_normal;
  last_turning_ = cross(unit_normal, motion_.angular_velocity);
  // The part of n across the axis turns with it: |n x w| / |w|.
  last_bend_ = (safe_norm(last_turning_) + 8.0 * kUnitRoundoff * spin_) * spin_ * from_axis_;
  if (a_turns()) {
    last_turning_of_a_ = cross(unit_normal, motion_of_a_.angular_velocity);
    last_bend_ += (safe_norm(last_turning_of_a_) + 8.0 * kUnitRoundoff * spin_of_a_) * spin_of_a_ * from_axis_a_;
  } else {
    last_of_a_ = a_.core_support(unit_normal);
    ++n_support_calls_;
  }
}

double RigidSweep::gap_during(const Vec3d& unit_normal, double from, double duration) {
  const double until = (from + duration) * (1.0 + 4.0 * kUnitRoundoff);
  const double middle = from + 0.5 * duration;
  // The middle and the ends are rounded.
  const double half = 0.5 * duration + (duration > 0.0 ? 4.0 * kUnitRoundoff * until : 0.0);
  Transformd turn = pose_at(a_from_b_, motion_.velocity, turning_, middle);
  const Vec3d origin = turn.translation;
  turn.translation = {};
  if (n_gaps_++ == 0 || !(norm_1(last_normal_ - unit_normal) == 0.0)) look_along(unit_normal);
  const Vec3d &turning = last_turning_, &turning_of_a = last_turning_of_a_;
  const Transformd turn_of_a = a_turns() ? this->turn_of_a(middle) : Transformd{};
  double least = HUGE_VAL, longest = 0.0;
  for (const double time : {-half, half}) {
    const Vec3d leaning = unit_normal + time * turning;
    const Vec3d of_b = turn(b_.core_support(-turn.direction_to_b(leaning)));
    ++n_support_calls_;
    longest = std::fmax(longest, norm_1(leaning));
    const Vec3d origin_then = origin + time * motion_.velocity;
    if (!a_turns()) {
      least = lesser(least, dot(unit_normal, origin_then - last_of_a_) + dot(leaning, of_b));
    } else {
      // The largest of linear functions is convex, and minus that concave.
      const Vec3d leaning_of_a = unit_normal + time * turning_of_a;
      const Vec3d of_a = turn_of_a(a_.core_support(turn_of_a.direction_to_b(leaning_of_a)));
      ++n_support_calls_;
      least = lesser(least, (dot(unit_normal, origin_then) + dot(leaning, of_b)) - dot(leaning_of_a, of_a));
      longest = std::fmax(longest, norm_1(leaning_of_a));
    }
    if (half == 0.0) break;
  }
  const double remainder = 0.5 * half * half * last_bend_ * kUp;
  return least - balls_ - remainder - support_error(until) * longest - pose_error(until);
}

double RigidSweep::short_time() const { return std::fmin(0x1p256, 8.0 / std::fmax(spin_, spin_of_a_)); }

// E23, about the start: the bound is the lesser one of both ends of the interval, as in `gap_during`, but no rotation
// has to be known for it, so that it can be had in twice the precision.
double RigidSweep::apart_until(double from, double last, const Vec3d& unit_normal, const LocalForms& forms) {
  // Lengths below are in units of 2^exponent. What is lost of them where products are subnormal is next to nothing.
  if (std::abs(forms.exponent()) > kLargestExponentAtStart) return from;
  const auto in_units = [&forms](double length) { return std::ldexp(length, -forms.exponent()); };
  const Vec3e n = broadcast<Extended>(unit_normal);
  const Vec3e turning = cross(n, broadcast<Extended>(motion_.angular_velocity));
  const Vec3e turning_of_a = cross(n, broadcast<Extended>(motion_of_a_.angular_velocity));
  const Vec3e velocity = broadcast<Extended>(times_power_of_two(motion_.velocity, -forms.exponent()));
  const Vec3e arm_a = forms.arm_of_a(), arm_b = spin_ > 0.0 ? forms.arm_of_b() : Vec3e{};
  const Extended rate = dot(n, velocity) + dot(turning, arm_b) - dot(turning_of_a, arm_a);
  const auto gap_at = [&](double time) {
    const Extended t(time);
    const Vec3e leaning = n + t * turning;
    const Extended of_b = forms.farthest_of_b(-leaning, forms.a_from_b().direction_to_b(-leaning)).height;
    const Extended of_a = forms.farthest_of_a(n + t * turning_of_a).height;
    n_support_calls_ += 2;
    return dot(n, forms.a_from_b().translation) + t * rate - of_b - of_a - forms.ball_radius() * norm(n);
  };
  // What bends, what is lost to rounding, and what a velocity that is a rounded difference is off by.
  const double bend = in_units(safe_norm(high_part(turning)) * spin_ * from_axis_ +
                               safe_norm(high_part(turning_of_a)) * spin_of_a_ * from_axis_a_);
  const double arms = norm_1(high_part(arm_a)) + norm_1(high_part(arm_b));
  const auto taken_off = [&](double until) {
    const double way = in_units(until * speed_1_);
    const double rounding = 16.0 * kExtendedError + 0x1p-90 * (1.0 + arms + way);
    return (0.5 * until * until * bend + rounding + velocity_error_ * way) * kUp;
  };
  const Extended gap_at_first = gap_at(from);
  // Concave in time, as all of its parts are; positive where the bodies are proven to be apart from `from` until then.
  const auto surplus_at = [&](double until) {
    const Extended gap = gap_at(until);
    return ((gap_at_first < gap ? gap_at_first : gap) - Extended(taken_off(until))).high;
  };
  double surplus = (gap_at_first - Extended(taken_off(from))).high;
  if (!(surplus > 0.0)) return from;
  // What bends takes half of it.
  const double end = std::fmin(std::fmin(short_time(), last), std::sqrt(surplus / bend));
  double proven = from, failed = HUGE_VAL, surplus_failed = 0.0, trial = end;
  for (int k = 0; k < kMostTrialsAtStart && trial > proven; ++k) {
    const double found = surplus_at(trial);
    if (found > 0.0) {
      proven = trial;
      surplus = found;
    } else {
      failed = trial;
      surplus_failed = found;
    }
    if (proven == end || proven > 0.5 * failed) break;
    // Where the chord comes to nought a concave function has not.
    trial = proven + (1.0 - 0x1p-10) * surplus / (surplus - surplus_failed) * (failed - proven);
  }
  return proven;
}

// K holds the points of a tetrahedron about the origin, and with it the ball in the tetrahedron, a third as large.
bool RigidSweep::meets_at(double time) {
  const Transformd pose = relative_pose(time);
  const double reach = a_.reach() + 2.0 * b_.reach() + norm_1(pose.translation);
  // Vertices of polytopes are rounded as they are placed, and so are the places of the corners.
  const double radius = pose_error(time) + 16.0 * kUnitRoundoff * reach;
  const double corner = 3.25 / std::numbers::sqrt3 * radius;
  constexpr std::array<Vec3d, 4> kCorners = {
      {{1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}}};
  for (const Vec3d& to : kCorners) {
    Transformd moved = pose;
    moved.translation = pose.translation + corner * to;
    const FilterResult found = filter_overlap(a_, b_, moved, kMostCallsOfContact);
    n_support_calls_ += found.n_support_calls;
    if (found.verdict.outcome == Outcome::overlap) continue;
    if (reach > kLeastLength && reach < kLargestLength) return false;
    // Of which the filter does not speak.
    const OverlapAnswer answer = overlap_answer(a_, b_, Pose::unchecked(moved));
    n_support_calls_ += answer.n_support_calls;
    if (answer.verdict.outcome != Outcome::overlap) return false;
  }
  return true;
}

RigidSweep::Window RigidSweep::window() const {
  // Of an A that turns the ball is about the origin of its frame, which stays.
  const Vec3d centre_a = a_turns() ? Vec3d{} : a_.centre();
  const double radius_a = a_turns() ? from_origin_a_ + a_.ball_radius() : a_.circumradius();
  const Vec3d from_a = a_from_b_.translation - centre_a;
  const double rounding = 32.0 * kUnitRoundoff * (norm_1(a_from_b_.translation) + norm_1(centre_a));
  const double radii = (radius_a + b_.ball_radius() + from_origin_) * (1.0 + 32.0 * kUnitRoundoff) + rounding;
  const double speed = safe_norm(motion_.velocity);
  if (!(speed > 0.0)) {
    if (safe_norm(from_a) > radii) return {1.0, 0.0};
    if (a_turns() && spin_ > 0.0) return {0.0, HUGE_VAL};
    const double turn = 2.0 * std::numbers::pi / (a_turns() ? spin_of_a_ : spin_) * kUp;
    return {0.0, turn * kUp};
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

// What can be proven of a body that turns while it moves, over an interval of time (docs/derivations.md, E23).
//
// Along a fixed unit vector n, from A towards B, the bodies are apart at time t by
//
//     g(t) = min over B of n . b(t)  -  max over A of n . a
//
// at least. About the middle of an interval n . b(t) is linear in time but for a remainder of second order, and the
// least of linear functions is concave: above the lesser of its values at the two ends. So three support points prove
// that nothing touches during the whole interval, however many points of B take the lead in turn.
#pragma once

#include <limits>

#include "engine/numeric/transform.h"
#include "engine/query/exact/extended_difference.h"
#include "engine/query/first_contact.h"
#include "engine/support/convex_body.h"

namespace vex {

/// In the frame that A's origin takes along, in A's directions at first: what moves straight is B, and A turns about
/// its origin. `is_exact`: the velocity is no rounded difference of two.
struct RelativeMotion {
  RigidMotion of_b;
  Vec3d spin_of_a;
  bool is_exact;
  bool turns;  // either body, if too slowly for its unit of time: else B is its vertices as they are rounded at first
};

/// An angular velocity as `pose_at` takes it: about a unit vector, speed * 2^exponent radians in a unit of time.
struct Spin {
  bool turns = false;
  Vec3d axis;
  int exponent = 0;
  double speed = 0.0;

  explicit Spin(const Vec3d& angular_velocity);
};

/// No number where one of them is none: that would prove nothing, and `fmin` leaves it out.
inline double lesser(double x, double y) { return x < y ? x : y <= x ? y : std::numeric_limits<double>::quiet_NaN(); }

/// No point of a body's core is farther from the origin of its frame, and from an axis through that. `turn`: a rotation
/// to the frame of the angular velocity.
struct CoreReach {
  double from_origin, from_axis;
};
CoreReach core_reach(const ConvexBody& body, const Transformd& turn, const Vec3d& angular_velocity);

class RigidSweep {
 public:
  /// `spin_of_a`, `is_exact`: as of a `RelativeMotion`. All vectors below are in A's frame as it is at first, but for
  /// `relative_pose`.
  RigidSweep(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion,
             const Vec3d& spin_of_a = {}, bool is_exact = false);

  /// Times outside of which the circumscribed balls are apart, proven: B's is about the origin of its frame, which
  /// moves straight, and so is A's if it turns. Nothing, from > to, where they never meet. Of one body that only turns,
  /// one turn; of two, for ever.
  struct Window {
    double from, to;
  };
  Window window() const;

  /// A lower bound of the gap along `unit_normal` at every time from `from` to `from` + `duration`.
  double gap_during(const Vec3d& unit_normal, double from, double duration);

  /// What a square of the duration takes off that bound is an eighth of this at least, along the normal of the last
  /// one.
  double bend() const { return last_bend_; }

  /// A time until which, `last` at most, nothing touches along that normal from `from` on, itself among them: shown in
  /// twice the precision, which tells gaps that double precision takes for contact. `from` where nothing is shown, as
  /// after `short_time`. `forms`: those of the bodies at the start, B rounded
  /// unless a body turns.
  double apart_until(double from, double last, const Vec3d& unit_normal, const LocalForms& forms);
  /// In which neither body turns by more than eight radians, and no square of a time is too large.
  double short_time() const;

  /// No point of B comes nearer along it, in a unit of time, than this.
  double most_speed(const Vec3d& unit_normal) const;

  /// The bodies share a point at that time, proven: they do as `pose_at` has them, and wherever its rounding may have
  /// taken B from.
  bool meets_at(double time);

  /// Of the gap along any vector: what rounding takes off the bounds.
  double rounding_at(double time) const;

  /// B's pose in A's frame as it is then; and vectors from that frame to the one at first, and back.
  Transformd relative_pose(double time) const;
  /// From A's to B's, to rounding.
  Vec3d between_centres(double time) const;
  Vec3d turned_with_a(double time, const Vec3d& vector) const;
  Vec3d turned_back(double time, const Vec3d& vector) const;
  int n_support_calls() const { return n_support_calls_; }

 private:
  void look_along(const Vec3d& unit_normal);
  bool a_turns() const { return spin_of_a_ > 0.0; }
  Transformd turn_of_a(double time) const;
  double pose_error(double time) const;
  double support_error(double time) const;

  const ConvexBody& a_;
  const ConvexBody& b_;
  Transformd a_from_b_;
  RigidMotion motion_;
  Spin turning_;
  double spin_, speed_1_;  // at least |w|; at least |v|
  double velocity_error_;  // of each coordinate, relative
  double from_origin_;     // no point of B's core is farther from the origin of its frame
  double from_axis_;       // nor from the axis through it
  RigidMotion motion_of_a_;
  Spin turning_of_a_;
  double spin_of_a_;
  double from_origin_a_ = 0.0, from_axis_a_ = 0.0;  // where A turns
  double at_first_, reach_, own_error_;             // of lengths that rounding is a part of, and of the supports' own
  double balls_;
  // What `gap_during` has of its last normal.
  Vec3d last_normal_, last_turning_, last_turning_of_a_, last_of_a_;
  double last_bend_ = 0.0;
  int n_gaps_ = 0, n_support_calls_ = 0;
};

}  // namespace vex

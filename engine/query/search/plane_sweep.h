// What can be proven of a body over a plane, at rest and while it moves and turns (docs/derivations.md, E29). Heights
// are n . x - c, times the length of the plane's normal n.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/first_contact.h"
#include "engine/query/half_space.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The least height over a placed body, which is within `error` of `value`; and its point.
struct LeastHeight {
  double value, error;
  Vec3d point_b, point_b_in_b;

  double lower() const { return value - error; }
  double upper() const { return value + error; }
};
LeastHeight least_height(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b);

/// Bounds of the speed at which heights fall where a body moves straight, -n . motion, of either sign; exact but for a
/// last place where the sign is not plain.
struct FallingSpeed {
  double lower, upper;
};
FallingSpeed falling_speed(const HalfSpace& a, const Vec3d& motion);

/// A body that turns while it moves. As a `RigidSweep` about a normal that stays, which it is not asked with.
class PlaneSweep {
 public:
  /// Holds references.
  PlaneSweep(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion);

  /// A lower bound of the least height at every time from `from` to `from` + `duration`.
  double gap_during(const Vec3d& unit_normal, double from, double duration);
  /// What a square of the duration takes off that bound is an eighth of this at least.
  double bend() const { return (spin_ * turning_) * from_axis_; }
  /// How far out of the tangent's height a point may bend in this time from the start on, rounded up.
  double fall_by_bending(double time) const;
  /// What computed heights are off by at that time.
  double rounding_at(double time) const;
  /// No point's height falls faster.
  double most_speed(const Vec3d& unit_normal) const;
  /// Whether the body is proven to share a point with the half-space at that time.
  bool meets_at(double time);

  /// Times outside of which a ball about the body is over the plane, proven. Nothing, from > to, where it always is. Of
  /// a body whose heights neither rise nor fall but by turning one turn.
  struct Window {
    double from, to;
  };
  Window window() const;

  int n_support_calls() const { return n_support_calls_; }

 private:
  double error_until(double time, double leaning_by) const;

  const HalfSpace& a_;
  const ConvexBody& b_;
  const Transformd& a_from_b_;
  const RigidMotion& motion_;
  Vec3d dir_turning_;                         // n x w
  double spin_, turning_;                     // |w| and |n x w|, rounded up
  double from_origin_ = 0, from_axis_ = 0;    // of the core's points, rounded up
  double height_at_first_, along_, along_v_;  // of B's origin; and what it and its rate are made of
  double drop_;                               // by the ball
  int n_support_calls_ = 0;
};

}  // namespace vex

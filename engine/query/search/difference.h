// K = A - B of two placed bodies, in double precision: the difference of their cores and one ball for both, times a
// power of two where that is wanted. What every search in one pose asks.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/support/combinators.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A unit vector of A's frame as B sees it, and as long: a pose's rotation is one to within Pose::kRotationTolerance
/// only, and what is that much too long leads off a ball. The root is a series, off by 10^-16 of itself.
inline Vec3d unit_seen_from_b(const Transformd& a_from_b, const Vec3d& unit) {
  const Vec3d turned = a_from_b.direction_to_b(unit);
  const double longer = dot(turned, turned) - 1.0;
  return (1.0 - longer * (0.5 - 0.375 * longer)) * turned;
}

/// Holds references. Support points are off by what query_error.h counts.
class Difference {
 public:
  Difference(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, double scale = 1.0)
      : a_(a), b_(b), a_from_b_(a_from_b), ball_radius_(a.ball_radius() + b.ball_radius()), scale_(scale) {}

  /// The farthest points of the cores, of A along a direction and of B against it.
  struct CorePoints {
    Vec3d a, b;   // in A's frame
    Vec3d own_b;  // the second in B's
  };
  /// For distances and rays. Which body is asked first changes no answer, but the time: B, or distances take 1 to 4 %
  /// longer; in `support` A, before the direction is turned for B, or overlap takes a tenth longer.
  CorePoints core_points(const Vec3d& dir) const {
    const Vec3d own_b = b_.core_support(-a_from_b_.direction_to_b(dir));
    return {a_.core_support(dir), a_from_b_(own_b), own_b};
  }
  /// The point of K that they make.
  Vec3d point(const CorePoints& cores, const Vec3d& dir) const {
    const Vec3d w = cores.a - cores.b;
    return scale_ * (ball_radius_ > 0.0 ? w + ball_support(ball_radius_, dir) : w);
  }
  /// Negated first, and turned then: where a product is 0 its sign is another one, which chooses among the corners of a
  /// box that are equally far. The calls that a search for overlap takes hang on it, and are to stay what they are.
  Vec3d support(const Vec3d& dir) const {
    const Vec3d of_a = a_.core_support(dir);
    const Vec3d own_b = b_.core_support(a_from_b_.direction_to_b(-dir));
    return point({of_a, a_from_b_(own_b), own_b}, dir);
  }

  const ConvexBody& a() const { return a_; }
  const ConvexBody& b() const { return b_; }
  const Transformd& a_from_b() const { return a_from_b_; }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  const Transformd& a_from_b_;
  double ball_radius_, scale_;
};

}  // namespace vex

// What is decided before any search: each body's own bounds against the other's circumscribed and inscribed balls.
//
// A box or an ellipsoid, rounded or not, is its own bound: the distance of a point to it says whether a ball there
// meets it. Of other bodies the bounds are the bounding box and the balls. Where B's centre lies in A's frame is known
// before B is turned, so the first of the two tests decides half of the trials of most pairs before their rotation is
// drawn.
#pragma once

#include <cstdint>

#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Proven: E5 in docs/derivations.md.
class QuickVerdict {
 public:
  /// Decides nothing.
  QuickVerdict() = default;
  /// R of every pose must be a rotation to within `rotation_error`: | |R|_2 - 1 | and | |R^-1|_2 - 1 | at most that,
  /// which is at most 1e-6.
  QuickVerdict(const ConvexBody& a, const ConvexBody& b, double rotation_error);

  template <class L>
  struct Answer {
    MaskOf<L> disjoint;
    MaskOf<L> overlap;
  };

  /// Of B's centre, as drawn or as placed, in A's frame: A against B's balls.
  template <class L>
  Answer<L> at(const Vec3<L>& centre_b) const {
    return answer(a_, centre_b, L(a_.error) * (L(reach_) + norm_1(centre_b)));
  }

  /// B against A's balls; whether that decides enough to be asked.
  bool turned_pays() const { return turned_pays_; }
  template <class L>
  Answer<L> turned(const Transform<L>& a_from_b) const {
    const Vec3<L> from_b = broadcast<L>(centre_a_) - a_from_b.translation;
    return answer(b_, a_from_b.direction_to_b(from_b), L(b_.error) * (L(reach_) + norm_1(from_b)));
  }

  /// Both, in this order.
  template <class L>
  Answer<L> operator()(const Transform<L>& a_from_b, const Vec3<L>& centre_b) const {
    const Answer<L> first = at(centre_b);
    if (!turned_pays_) return first;
    const Answer<L> second = turned(a_from_b);
    return {either(first.disjoint, but_not(second.disjoint, first.overlap)),
            either(first.overlap, but_not(second.overlap, first.disjoint))};
  }
  template <class L>
  Answer<L> operator()(const Transform<L>& a_from_b) const {
    return (*this)(a_from_b, a_from_b(broadcast<L>(centre_b_)));
  }

 private:
  // One body's bounds, in its own frame, and the other's balls.
  struct Bounds {
    enum class Kind : std::uint8_t {
      none,
      balls,      // both about `centre`
      box,        // the body is this box, rounded
      ellipsoid,  // the body is this ellipsoid about the origin, rounded
      balls_box,  // within the rounded box and the ball about `centre`, around the other ball about it
    };
    Kind kind = Kind::none;
    Vec3d centre, lower, upper, reciprocal_axes;
    double outer = 0, inner = 0;  // distances from the box or ellipsoid, or from the centre
    double outer_ball = 0;        // of balls_box: distance from the centre
    double error = 0;             // of the point's place, in units of `reach_` and the place's own size
  };

  static Bounds bounds_of(const ConvexBody& body, const ConvexBody& other, double rotation_error);

  // Whether a ball about each point meets what is bounded.
  template <class L>
  static Answer<L> answer(const Bounds& bounds, const Vec3<L>& point, const L& error) {
    const L zero(0.0), outer = L(bounds.outer) + error, inner = L(bounds.inner) - error;
    switch (bounds.kind) {
      case Bounds::Kind::balls: {
        const L distance_sq = square_norm(point - broadcast<L>(bounds.centre));
        return {distance_sq > outer * outer, both(inner > zero, distance_sq < inner * inner)};
      }
      case Bounds::Kind::box: {
        const L distance_sq = square_norm(gap(bounds, point));
        return {distance_sq > outer * outer, both(inner > zero, distance_sq < inner * inner)};
      }
      case Bounds::Kind::balls_box: {
        const L from_box_sq = square_norm(gap(bounds, point));
        const L distance_sq = square_norm(point - broadcast<L>(bounds.centre));
        const L outer_ball = L(bounds.outer_ball) + error;
        return {either(from_box_sq > outer * outer, distance_sq > outer_ball * outer_ball),
                both(inner > zero, distance_sq < inner * inner)};
      }
      case Bounds::Kind::ellipsoid: {
        // With k = |D^-1 p|: the plane across n = D^-2 p has p k^2 and the ellipsoid k before it; and p / k is a point
        // of the ellipsoid.
        const Vec3<L> image = scaled(point, bounds.reciprocal_axes);
        const Vec3<L> normal = scaled(image, bounds.reciprocal_axes);
        const L k_sq = square_norm(image), k = square_root(k_sq);
        const L rounding(16.0 * kUnitRoundoff);
        const L ahead = (k_sq - k) - rounding * (k_sq + k);
        const L outside = larger((k - L(1.0)) + rounding * (k + L(1.0)), zero);
        return {both(ahead > zero, ahead * ahead > (outer * outer) * square_norm(normal)),
                both(inner > zero, square_norm(point) * (outside * outside) < (inner * inner) * k_sq)};
      }
      case Bounds::Kind::none: break;
    }
    return {MaskOf<L>(false), MaskOf<L>(false)};
  }

  template <class L>
  static L square_norm(const Vec3<L>& v) {
    return dot(v, v);
  }
  template <class L>
  static Vec3<L> scaled(const Vec3<L>& v, const Vec3d& by) {
    return {L(by.x) * v.x, L(by.y) * v.y, L(by.z) * v.z};
  }
  // From the box to the point.
  template <class L>
  static Vec3<L> gap(const Bounds& bounds, const Vec3<L>& point) {
    const L zero(0.0);
    return {larger(larger(L(bounds.lower.x) - point.x, point.x - L(bounds.upper.x)), zero),
            larger(larger(L(bounds.lower.y) - point.y, point.y - L(bounds.upper.y)), zero),
            larger(larger(L(bounds.lower.z) - point.z, point.z - L(bounds.upper.z)), zero)};
  }

  Vec3d centre_a_, centre_b_;
  double reach_ = 0.0;
  Bounds a_, b_;
  bool turned_pays_ = false;
};

}  // namespace vex

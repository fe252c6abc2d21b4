// The point of a body K = A - B that is nearest to the origin: the descent of E. Gilbert, D. Johnson and S. Keerthi
// (1988), with bounds of the distance on both sides.
#pragma once

#include "engine/query/search/nearest_simplex.h"
#include "engine/query/search/query_error.h"

namespace vex {

/// Where a descent may stop before the bounds have met.
enum class DescentGoal {
  nearest,    // nowhere
  separated,  // once a direction separates the bodies
};

/// One lane only. All distances are those of K, which may be the difference of the bodies' cores.
template <class L, class Point>
struct NearestDescent {
  enum class End {
    converged,      // the bounds are as near as asked for
    separated,      // the goal was a separating direction, and `normal` is one
    around_origin,  // the simplex holds the origin, to rounding
    touching,       // the nearest point is the origin, to rounding
    stalled,        // rounding allows no nearer point
    capped,
  };
  End end = End::stalled;
  NearestSimplex<L, Point> simplex;
  Vec3<L> normal;           // unit, from the simplex' nearest point to the origin; where separated, it separates
  Vec3<L> normal_of_lower;  // unit, the one that has shown `lower`; zero where none has
  L lower{0.0};             // of the distance, rounding included; negative where nothing is known
  L upper{0.0};
  L missing{0.0};  // where converged or stalled: of the simplex' distance, in what `normal` alone shows
  int n_support_calls = 0;
};

/// `Difference::support(n)` gives the `Point` of K that is farthest along a unit vector. `simplex`: points of K, if any
/// are known. `wanted`: how near the bounds shall be, rounding apart, for a distance. `radius`: the ball about K's
/// points that `separated` means.
template <class L, class Point, class Difference, class Wanted>
NearestDescent<L, Point> descend_to_origin(const Difference& difference, const Vec3<L>& first_dir,
                                           const NearestSimplex<L, Point>& simplex, const QueryError<L>& error,
                                           const Wanted& wanted, const L& radius, DescentGoal goal,
                                           int max_support_calls) {
  using End = typename NearestDescent<L, Point>::End;
  const L slack = L(2.0) * error.support;  // E20
  NearestDescent<L, Point> result;
  result.simplex = simplex;
  if (simplex.size() == 0) {
    result.simplex.add(difference.support(first_dir));
    result.n_support_calls = 1;
  }
  result.lower = -error.reach;
  Vec3<L>& best_normal = result.normal_of_lower;
  while (true) {
    const L length = square_root(result.simplex.square());
    result.upper = length + slack;
    if (result.simplex.is_around_origin() || !(length > slack)) {
      result.end = result.simplex.is_around_origin() ? End::around_origin : End::touching;
      return result;
    }
    const Vec3<L> scaled = scaled_to_unit_exponent(result.simplex.normal());
    result.normal = (L(-1.0) / norm(scaled)) * scaled;
    if (result.n_support_calls >= max_support_calls) {
      result.end = End::capped;
      return result;
    }
    const Point found = difference.support(result.normal);
    ++result.n_support_calls;
    const L in_front = -dot(result.normal, found.w);
    if (in_front - slack > result.lower) {
      result.lower = in_front - slack;
      best_normal = result.normal;
    }
    if (goal == DescentGoal::separated && in_front - slack > radius) {
      result.end = End::separated;
      return result;
    }
    if (length - in_front <= wanted(length)) {
      result.missing = length - in_front;
      result.end = End::converged;
      return result;
    }
    if (!result.simplex.add(found, !(result.lower > L(0.0)))) {
      // Next to the origin the nearest point's direction is all rounding, and an earlier one may have been better: the
      // one along which, or to the point of which, less is missing.
      const Vec3<L> aside = result.simplex.at() + length * best_normal;
      result.missing = length - in_front;
      if (dot(aside, aside) < result.missing * result.missing && norm_1(best_normal) > L(0.0)) {
        result.normal = best_normal;
        result.missing = (length - result.lower) - slack;
      }
      result.end = End::stalled;
      return result;
    }
  }
}

}  // namespace vex

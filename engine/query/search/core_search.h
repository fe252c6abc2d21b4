// How far a difference K = A - B is from the origin, or how deep the origin is in it: a descent to the nearest point
// (nearest_descent.h), and where K holds the origin the expanding polytope (expanding_polytope.h), both with bounds.
#pragma once

#include "engine/numeric/interval.h"
#include "engine/query/search/expanding_polytope.h"
#include "engine/query/search/nearest_descent.h"

namespace vex {

enum class SeparationGoal { signed_distance, distance, depth };

template <class L>
struct CoreSearchSettings {
  SeparationGoal goal;
  L radii;  // of the balls about the cores
  L size;   // R_A + R_B
  L relative_gap;
  int max_support_calls;
  int max_hull_points;
  L max_distance;      // of the bodies; distances that are larger need not be known
  L allowed_gap{0.0};  // a relative gap that will do, if it is larger

  /// How near to each other bounds shall be for this signed distance of the cores.
  L wanted(const L& signed_distance) const { return relative_gap * (absolute(signed_distance - radii) + size); }
};

/// What was found of the cores. With the default values: that they overlap, and no more.
template <class L, class Point>
struct CoreSeparation {
  Vec3<L> normal;              // unit
  L distance;                  // signed, along it
  Interval<L> bounds;          // of the signed distance of the cores, rounding included
  L missing{0.0};              // of the signed distance, in what the normal alone shows,
  bool tells_missing = false;  // where this is true
  WeightedPoints<L, Point> points;
  bool has_normal = false;
  bool is_capped = false;  // more support calls would bring the bounds nearer
};

template <class L, class Point, class Difference>
class CoreSearch {
 public:
  /// Descends from the points of a simplex, or along a direction.
  CoreSearch(const Difference& difference, const QueryError<L>& error, const CoreSearchSettings<L>& settings,
             const Vec3<L>& first_dir, const NearestSimplex<L, Point>& simplex)
      : difference_(difference),
        error_(error),
        settings_(settings),
        descent_(descend_to_origin<L, Point>(
            difference, first_dir, simplex, error, [&](const L& distance) { return settings.wanted(distance); },
            settings.goal == SeparationGoal::depth ? settings.radii : beyond(settings.radii + settings.max_distance),
            settings.goal == SeparationGoal::signed_distance ? DescentGoal::nearest : DescentGoal::separated,
            settings.max_support_calls)),
        n_support_calls_(descent_.n_support_calls) {
    found_.bounds = {descent_.lower, descent_.upper};
    found_.is_capped = descent_.end == Descent::End::capped;
    // A descent that ends so near to the origin that no direction separates is one that touches.
    const bool meets = descent_.end == Descent::End::around_origin || descent_.end == Descent::End::touching ||
                       descent_.end == Descent::End::stalled;
    if (!meets || descent_.lower > L(0.0)) {
      found_.normal = descent_.normal;
      found_.has_normal = norm_1(found_.normal) > L(0.0);
      found_.distance = square_root(descent_.simplex.square());
      found_.missing = descent_.missing;
      found_.tells_missing = descent_.end == Descent::End::converged || descent_.end == Descent::End::stalled;
      found_.points = descent_.simplex.points();
      return;
    }
    // That they overlap may be all that is asked.
    const bool meets_by_balls = settings.radii > L(0.0) && descent_.upper < settings.radii;
    wants_depth_ = settings.goal != SeparationGoal::distance || !(meets_by_balls || !(settings.radii > L(0.0)));
  }

  /// Whether the cores overlap, and how deep is asked.
  bool wants_depth() const { return wants_depth_; }

  using Polytope = ExpandingPolytope<L, Point, Difference>;

  void find_depth() {
    find_depth([](const Polytope&) {});
  }
  /// `see(polytope)`, once it has ended with bounds that are as near as asked for.
  template <class See>
  void find_depth(const See& see) {
    thread_local PolytopeStore<L, Point> store;
    Polytope polytope(difference_, error_, settings_.max_hull_points, store);
    const typename Polytope::End end =
        polytope.run(descent_.simplex, [&](const L& depth) { return settings_.wanted(-depth); });
    n_support_calls_ += polytope.n_support_calls();
    if (end == Polytope::End::converged) see(polytope);
    found_.is_capped = end == Polytope::End::capped;
    found_.normal = polytope.normal();
    found_.has_normal = true;
    found_.distance = -polytope.height();
    // Of a K whose ways out tie the descent may have hit one, and the polytope none.
    const bool is_of_descent = found_.bounds.lower + polytope.depth_upper() > L(4.0) * error_.support;
    if (is_of_descent) {
      found_.normal = descent_.normal_of_lower;
      found_.distance = found_.bounds.lower;
    }
    found_.bounds.lower = larger(found_.bounds.lower, -polytope.depth_upper());
    if (end == Polytope::End::separated) {
      found_.distance = square_root(descent_.simplex.square());
      found_.points = descent_.simplex.points();
      return;
    }
    found_.tells_missing = true;  // nothing: the depth is what K reaches along the normal
    Vec3<L> foot;
    if (end != Polytope::End::flat) {
      const L depth_lower = polytope.depth_lower();
      if (-depth_lower < found_.bounds.upper) found_.bounds.upper = -depth_lower;
      const auto add = [&](const L& weight, const Point& point) {
        found_.points.add(weight, point);
        foot = foot + weight * point.w;
      };
      is_of_descent ? polytope.visit_foot_along(found_.normal, add) : polytope.visit_foot(add);
    }
    // Of cores that hardly meet, the nearest points are those of the descent.
    const Vec3<L> out = -found_.distance * found_.normal;
    if (found_.points.size() == 0 || norm_1(descent_.simplex.at() - out) < norm_1(foot - out)) {
      found_.points = descent_.simplex.points();
    }
  }

  const CoreSeparation<L, Point>& found() const { return found_; }
  int n_support_calls() const { return n_support_calls_; }

 private:
  // What is larger than a sum is so still when radii and rounding have been taken off, and it is rounded.
  static L beyond(const L& sum) { return sum < L(HUGE_VAL) ? L(1.0 + 0x1p-48) * sum : sum; }

  using Descent = NearestDescent<L, Point>;

  const Difference& difference_;
  const QueryError<L>& error_;
  const CoreSearchSettings<L>& settings_;
  Descent descent_;
  CoreSeparation<L, Point> found_;
  int n_support_calls_;
  bool wants_depth_ = false;
};

}  // namespace vex

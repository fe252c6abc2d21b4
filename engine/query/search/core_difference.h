// K = A - B of two bodies' cores, their balls and rolling balls apart, with the points of both bodies: what distances
// and depths are searched for in.
#pragma once

#include "engine/query/exact/extended_difference.h"
#include "engine/query/search/query_error.h"
#include "engine/query/separation.h"
#include "engine/support/convex_body.h"

namespace vex {

/// In double precision.
class CoreDifference {
 public:
  struct Point {
    Vec3d w;      // a - b
    Vec3d a, b;   // of the cores, in A's frame
    Vec3d own_b;  // b in B's frame, without its rolling ball
  };

  CoreDifference(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b)
      : a_(a), b_(b), a_from_b_(a_from_b), rolling_a_(a.rolling_radius()), rolling_b_(b.rolling_radius()) {}

  Point support(const Vec3d& normal) const {
    const Vec3d of_a = a_.core_support(normal);
    const Vec3d of_b = b_.core_support(-a_from_b_.direction_to_b(normal));
    if (has_rolling()) {
      const Vec3d a = of_a - rolling_a_ * normal, b = a_from_b_(of_b) + rolling_b_ * normal;
      return {a - b, a, b, of_b};
    }
    return at(of_a, of_b);
  }
  Point at(const Vec3d& of_a, const Vec3d& of_b) const {
    const Vec3d b = a_from_b_(of_b);
    return {of_a - b, of_a, b, of_b};
  }
  bool is_of(const WarmStart& warm_start) const {
    return a_.is_same_as(warm_start.body_a) && b_.is_same_as(warm_start.body_b);
  }
  /// Without its points.
  void remember(WarmStart& warm_start, const Vec3d& dir) const {
    if (!is_of(warm_start)) {
      warm_start.body_a = a_.identity();
      warm_start.body_b = b_.identity();
    }
    warm_start.dir = dir;
    warm_start.n_points = 0;
  }
  bool has_rolling() const { return rolling_a_ > 0.0 || rolling_b_ > 0.0; }

  QueryError<double> error() const {
    QueryError<double> error = query_error(a_, b_, a_from_b_);
    error.support += 8.0 * kUnitRoundoff * (rolling_a_ + rolling_b_);
    return error;
  }
  double radius_a() const { return a_.ball_radius() + rolling_a_; }
  double radius_b() const { return b_.ball_radius() + rolling_b_; }
  Vec3d between_centres() const { return a_from_b_(b_.centre()) - a_.centre(); }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  const Transformd& a_from_b_;
  double rolling_a_, rolling_b_;
};

/// In twice the precision, from the exact forms, in the units and about the middles of the local forms.
class ExtendedCore {
 public:
  struct Point {
    Vec3e w;
    Vec3d a, b;  // of the cores, in the bodies' own frames, rounded
  };

  explicit ExtendedCore(const LocalForms& forms) : forms_(forms) {}

  Point support(const Vec3e& normal) const {
    const LocalForms::Farthest a = forms_.farthest_of_a(normal);
    const LocalForms::Farthest b = forms_.farthest_of_b(-normal, forms_.a_from_b().direction_to_b(-normal));
    return {(a.point - b.point) - forms_.a_from_b().translation, a.own, b.own};
  }

 private:
  const LocalForms& forms_;
};

}  // namespace vex

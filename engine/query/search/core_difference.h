// K = A - B of two bodies' cores, their balls and rolling balls apart, with the points of both bodies: what distances
// and depths are searched for in.
#pragma once

#include "engine/query/exact/extended_difference.h"
#include "engine/query/search/difference.h"
#include "engine/query/search/nearest_simplex.h"
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
    Vec3d own_b;  // b in B's frame
  };

  CoreDifference(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b)
      : difference_(a, b, a_from_b), rolling_a_(a.rolling_radius()), rolling_b_(b.rolling_radius()) {}

  Point support(const Vec3d& normal) const {
    const Difference::CorePoints cores = difference_.core_points(normal);
    if (!has_rolling()) return {cores.a - cores.b, cores.a, cores.b, cores.own_b};
    const Vec3d a = cores.a - rolling_a_ * normal, b = cores.b + rolling_b_ * normal;
    return {a - b, a, b, cores.own_b + rolling_b_ * difference_.a_from_b().direction_to_b(normal)};
  }
  Point at(const Vec3d& of_a, const Vec3d& own_b) const {
    const Vec3d b = difference_.a_from_b()(own_b);
    return {of_a - b, of_a, b, own_b};
  }
  bool is_of(const WarmStart& warm_start) const {
    return difference_.a().is_same_as(warm_start.body_a_) && difference_.b().is_same_as(warm_start.body_b_);
  }
  /// The direction that a warm start tells, or zero.
  static Vec3d dir_of(const WarmStart* warm_start) { return warm_start != nullptr ? warm_start->dir_ : Vec3d{}; }
  /// Its points, if they are of these bodies and have no balls rolling on them.
  NearestSimplex<double, Point> simplex_of(const WarmStart* warm_start) const {
    NearestSimplex<double, Point> simplex;
    if (warm_start == nullptr || has_rolling() || !is_of(*warm_start)) return simplex;
    for (std::size_t k = 0; k < static_cast<std::size_t>(warm_start->n_points_) && !simplex.is_around_origin(); ++k) {
      simplex.add(at(warm_start->of_a_[k], warm_start->of_b_[k]));
    }
    return simplex;
  }
  /// Without its points.
  void remember(WarmStart& warm_start, const Vec3d& dir) const {
    if (!is_of(warm_start)) {
      warm_start.body_a_ = difference_.a().identity();
      warm_start.body_b_ = difference_.b().identity();
    }
    warm_start.dir_ = dir;
    warm_start.n_points_ = 0;
  }
  void remember_point(WarmStart& warm_start, const Point& point) const {
    if (has_rolling()) return;
    const std::size_t k = static_cast<std::size_t>(warm_start.n_points_++);
    warm_start.of_a_[k] = point.a;
    warm_start.of_b_[k] = point.own_b;
  }
  bool has_rolling() const { return rolling_a_ > 0.0 || rolling_b_ > 0.0; }

  QueryError<double> error() const {
    QueryError<double> error = query_error(difference_.a(), difference_.b(), difference_.a_from_b());
    error.support += 8.0 * kUnitRoundoff * (rolling_a_ + rolling_b_);
    return error;
  }
  double radius_a() const { return difference_.a().ball_radius() + rolling_a_; }
  double radius_b() const { return difference_.b().ball_radius() + rolling_b_; }
  Vec3d between_centres() const { return difference_.a_from_b()(difference_.b().centre()) - difference_.a().centre(); }

 private:
  Difference difference_;
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

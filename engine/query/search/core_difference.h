// K = A - B of two bodies' cores, their balls and rolling balls apart, with the points of both bodies: what distances
// and depths are searched for in.
#pragma once

#include "engine/query/exact/extended_difference.h"
#include "engine/query/search/difference.h"
#include "engine/query/search/query_error.h"
#include "engine/query/search/weighted_points.h"
#include "engine/support/convex_body.h"

namespace vex {

/// In double precision.
class CoreDifference {
 public:
  struct Point {
    Vec3d w;      // of the difference, without rolling balls
    Vec3d a;      // of A's core, in A's frame
    Vec3d own_b;  // of B's, in B's
    Vec3d dir;    // along which the difference was asked for it: a unit vector
  };
  static double height_of(const Point& point) { return dot(point.dir, point.w); }

  CoreDifference(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b)
      : difference_(a, b, a_from_b), rolling_a_(a.rolling_radius()), rolling_b_(b.rolling_radius()) {}

  Point support(const Vec3d& normal) const {
    const Difference::CorePoints cores = difference_.core_points(normal);
    if (!has_rolling()) return {cores.a - cores.b, cores.a, cores.own_b, normal};
    const Vec3d a = cores.a - rolling_a_ * normal, b = cores.b + rolling_b_ * normal;
    return {a - b, cores.a, cores.own_b, normal};
  }
  /// Of points of the cores that are known: along no direction, and of bodies without rolling balls.
  Point at(const Vec3d& of_a, const Vec3d& own_b) const {
    return {of_a - difference_.a_from_b()(own_b), of_a, own_b, {}};
  }
  /// The points of the cores that make a combination of points. A rolling ball is one in the frame of its body, which
  /// is where its centre has to be told.
  Difference::CorePoints cores_of(const WeightedPoints<double, Point>& points) const {
    Vec3d a = weighted_sum(points, &Point::a), own_b = weighted_sum(points, &Point::own_b);
    Vec3d b = difference_.a_from_b()(own_b);
    if (has_rolling()) {
      const Vec3d dir = weighted_sum(points, &Point::dir);
      a = a - rolling_a_ * dir;
      b = b + rolling_b_ * dir;
      for (std::size_t k = 0; k < points.size(); ++k) {
        own_b = own_b + (points.weight(k) * rolling_b_) * unit_seen_from_b(difference_.a_from_b(), points.point(k).dir);
      }
    }
    return {a, b, own_b};
  }
  /// Directions that turn with B, and back.
  Vec3d turned_with_b(const Vec3d& own_dir) const {
    const Transformd& pose = difference_.a_from_b();
    return {dot(pose.row_x, own_dir), dot(pose.row_y, own_dir), dot(pose.row_z, own_dir)};
  }
  Vec3d seen_from_b(const Vec3d& dir) const { return difference_.a_from_b().direction_to_b(dir); }
  const ConvexBody& a() const { return difference_.a(); }
  const ConvexBody& b() const { return difference_.b(); }
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

#include "apps/referees/exact_referee.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/referees/exact_ellipsoids.h"
#include "apps/referees/exact_overlap.h"
#include "engine/numeric/expect.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

using exact::exactly;
using exact::inner;
using exact::minus;
using exact::Point;
using exact::Rational;

Point point_on(const Point& from, const Point& along, const Rational& s) {
  return {from[0] + s * along[0], from[1] + s * along[1], from[2] + s * along[2]};
}

Rational squared(const Rational& x) { return x * x; }

// A point of `middle` + s `along`, |s| <= 1; a single point where `along` is zero.
struct Segment {
  Point middle, along;
};

Rational distance_sq(const Point& p, const Segment& segment) {
  const Point from_p = minus(segment.middle, p);
  const Rational length_sq = inner(segment.along, segment.along);
  Rational s = 0;
  if (length_sq != 0) s = std::clamp(Rational(-inner(from_p, segment.along) / length_sq), Rational(-1), Rational(1));
  const Point nearest = point_on(from_p, segment.along, s);
  return inner(nearest, nearest);
}

// A convex quadratic over a square: its free minimum where that lies inside, or the least over the four sides.
Rational distance_sq(const Segment& a, const Segment& b) {
  const Point between = minus(b.middle, a.middle);
  const Rational aa = inner(a.along, a.along), ab = inner(a.along, b.along), bb = inner(b.along, b.along);
  const Rational determinant = aa * bb - ab * ab;
  if (determinant != 0) {
    const Rational ra = inner(between, a.along), rb = inner(between, b.along);
    const Rational s = (ra * bb - rb * ab) / determinant, q = (ra * ab - rb * aa) / determinant;
    if (abs(s) <= 1 && abs(q) <= 1) {
      const Point d = minus(point_on(between, b.along, q), point_on({}, a.along, s));
      return inner(d, d);
    }
  }
  return std::min({distance_sq(point_on(a.middle, a.along, -1), b), distance_sq(point_on(a.middle, a.along, 1), b),
                   distance_sq(point_on(b.middle, b.along, -1), a), distance_sq(point_on(b.middle, b.along, 1), a)});
}

Outcome within(const Rational& distance_sq, const Rational& reach) {
  return distance_sq <= squared(reach) ? Outcome::overlap : Outcome::disjoint;
}

// A ball swept along a segment of the z axis: a capsule, or a sphere.
struct Swept {
  double half_length, radius;
};

std::optional<Swept> swept(const ConvexBody& body) {
  if (const auto* const sphere = body.target<Sphere>()) return Swept{0.0, sphere->circumradius()};
  if (const auto* const capsule = body.target<Capsule>()) {
    return Swept{0.5 * capsule->body().length(), capsule->radius()};
  }
  return std::nullopt;
}

Outcome swept_outcome(const Swept& a, const Swept& b, const Transformd& pose) {
  const Segment axis_a{{}, {0, 0, Rational(a.half_length)}};
  const Point column = exactly({pose.row_x.z, pose.row_y.z, pose.row_z.z});
  const Segment axis_b{exactly(pose.translation), point_on({}, column, Rational(b.half_length))};
  return within(distance_sq(axis_a, axis_b), Rational(a.radius) + Rational(b.radius));
}

Outcome box_and_sphere_outcome(const Box& a, double radius, const Transformd& pose) {
  const Point centre = exactly(pose.translation), half = exactly(0.5 * a.edges());
  Rational sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational beyond = abs(centre[i]) - half[i];
    if (beyond > 0) sum += squared(beyond);
  }
  return within(sum, Rational(radius));
}

Outcome sphere_and_box_outcome(double radius, const Box& b, const Transformd& pose) {
  std::vector<Point> points;
  for (const Vec3d& v : exact::placed(b.vertices(), pose)) points.push_back(exactly(v));
  return within(exact::distance_sq_from_origin(points), Rational(radius));
}

// Semi-axes; none where the body is neither ellipsoid nor sphere.
std::optional<Vec3d> semi_axes(const ConvexBody& body) {
  if (const auto* const ellipsoid = body.target<Ellipsoid>()) return ellipsoid->semi_axes();
  if (const auto* const sphere = body.target<Sphere>()) {
    return Vec3d{sphere->circumradius(), sphere->circumradius(), sphere->circumradius()};
  }
  return std::nullopt;
}

std::optional<Outcome> outcome_if_known(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  const auto *const box_a = a.target<Box>(), *const box_b = b.target<Box>();
  const auto *const sphere_a = a.target<Sphere>(), *const sphere_b = b.target<Sphere>();
  if (box_a != nullptr && box_b != nullptr) {
    const bool meets = exact::overlap(box_a->vertices(), exact::placed(box_b->vertices(), pose));
    return meets ? Outcome::overlap : Outcome::disjoint;
  }
  if (sphere_a != nullptr && box_b != nullptr) return sphere_and_box_outcome(sphere_a->circumradius(), *box_b, pose);
  if (box_a != nullptr && sphere_b != nullptr) return box_and_sphere_outcome(*box_a, sphere_b->circumradius(), pose);
  const std::optional<Swept> swept_a = swept(a), swept_b = swept(b);
  if (swept_a && swept_b) return swept_outcome(*swept_a, *swept_b, pose);
  const std::optional<Vec3d> axes_a = semi_axes(a), axes_b = semi_axes(b);
  if (!axes_a || !axes_b) return std::nullopt;
  Transformd own = pose;
  if (sphere_b != nullptr) {
    own = {};
    own.translation = pose.translation;
  }
  return exact::ellipsoids_overlap(*axes_a, *axes_b, own) ? Outcome::overlap : Outcome::disjoint;
}

}  // namespace

bool has_exact_outcome(const ConvexBody& a, const ConvexBody& b) { return outcome_if_known(a, b, {}).has_value(); }

Outcome exact_outcome(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b) {
  const std::optional<Outcome> outcome = outcome_if_known(a, b, a_from_b);
  VEX_EXPECT(outcome.has_value());
  return outcome.value();
}

}  // namespace vex

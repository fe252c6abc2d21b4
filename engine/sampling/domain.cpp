#include "engine/sampling/domain.h"

#include <numbers>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// A drawn R may stretch B, and the position is rounded, by parts in 10^14: the domains are wider by far more than that,
// and their volume is computed after widening, so that the estimate stays what it says.
constexpr double kWidening = 1.0 + 0x1p-40;

// Half the width of A along one axis and the middle between its two support values.
struct Interval {
  double middle, half_width;
};

Interval extent_along(const ConvexBody& body, const Vec3d& unit_axis) {
  const double upper = dot(unit_axis, body.support(unit_axis)) + body.support_error();
  const double lower = dot(unit_axis, body.support(-unit_axis)) - body.support_error();
  return {0.5 * (upper + lower), 0.5 * (upper - lower)};
}

}  // namespace

Domain ball_domain(const ConvexBody& a, const ConvexBody& b) {
  Domain domain;
  domain.kind = Domain::Kind::ball;
  domain.middle = a.centre();
  domain.radius = (a.circumradius() + b.circumradius()) * kWidening;
  domain.volume = (4.0 / 3.0) * std::numbers::pi * (domain.radius * domain.radius * domain.radius);
  return domain;
}

Domain box_domain(const ConvexBody& a, const ConvexBody& b) {
  Domain domain;
  domain.kind = Domain::Kind::box;
  const Interval x = extent_along(a, {1.0, 0.0, 0.0});
  const Interval y = extent_along(a, {0.0, 1.0, 0.0});
  const Interval z = extent_along(a, {0.0, 0.0, 1.0});
  const double margin = b.circumradius() + 8.0 * kUnitRoundoff * a.reach();
  domain.middle = {x.middle, y.middle, z.middle};
  domain.half_extent = {(x.half_width + margin) * kWidening, (y.half_width + margin) * kWidening,
                        (z.half_width + margin) * kWidening};
  domain.volume = 8.0 * (domain.half_extent.x * domain.half_extent.y * domain.half_extent.z);
  return domain;
}

bool aligned_difference_is_flat(const ConvexBody& a, const ConvexBody& b) {
  const auto is_flat_along = [](const ConvexBody& body, const Vec3d& unit_axis) {
    return dot(unit_axis, body.support(unit_axis)) == dot(unit_axis, body.support(-unit_axis));
  };
  for (const Vec3d& unit_axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
    if (is_flat_along(a, unit_axis) && is_flat_along(b, unit_axis)) return true;
  }
  return false;
}

bool hits_by_construction(const ConvexBody& a, const ConvexBody& b, const Domain& domain) {
  const auto is_ball = [](const ConvexBody& body) {
    return body.inradius() >= body.circumradius() * (1.0 - gamma(16));
  };
  return domain.kind == Domain::Kind::ball && is_ball(a) && is_ball(b);
}

Domain best_domain(const ConvexBody& a, const ConvexBody& b) {
  const Domain ball = ball_domain(a, b);
  const Domain box = box_domain(a, b);
  // Of near-balls nearly every trial in the ball hits, and the misses that an error is taken from do not come.
  constexpr double kFewestMisses = 1e-3;
  const double inner = (a.inradius() + b.inradius()) / ball.radius;
  const bool lacks_misses = inner * inner * inner > 1.0 - kFewestMisses && !hits_by_construction(a, b, ball);
  return box.volume < ball.volume || lacks_misses ? box : ball;
}

}  // namespace vex

#include "engine/sampling/domain.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/numeric/interval.h"
#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// A drawn R may stretch B, and the position is rounded, by parts in 10^14: the domains are wider by far more than that,
// and their volume is computed after widening, so that the estimate stays what it says.
constexpr double kWidening = 1.0 + 0x1p-40;

Interval<double> extent_along(const ConvexBody& body, const Vec3d& unit_axis) {
  const double upper = dot(unit_axis, body.support(unit_axis)) + body.support_error();
  const double lower = dot(unit_axis, body.support(-unit_axis)) - body.support_error();
  return {lower, upper};
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
  const Interval<double> x = extent_along(a, {1.0, 0.0, 0.0});
  const Interval<double> y = extent_along(a, {0.0, 1.0, 0.0});
  const Interval<double> z = extent_along(a, {0.0, 0.0, 1.0});
  const double margin = b.circumradius() + 8.0 * kUnitRoundoff * a.reach();
  domain.middle = {x.middle(), y.middle(), z.middle()};
  domain.half_extent = {(x.half_width() + margin) * kWidening, (y.half_width() + margin) * kWidening,
                        (z.half_width() + margin) * kWidening};
  domain.volume = 8.0 * (domain.half_extent.x * domain.half_extent.y * domain.half_extent.z);
  return domain;
}

bool is_ball(const ConvexBody& body) { return body.inradius() >= body.circumradius() * (1.0 - gamma(16)); }

bool difference_is_flat(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law) {
  if (law.dimension() > 0 && !law.keeps_axes_parallel()) return false;
  constexpr double kRounding = 0x1p-44;  // of a rotation (kDrawnRotationError), four times
  const auto is_flat_along = [](const ConvexBody& body, const Vec3d& dir) {
    const double width = dot(dir, body.support(dir)) + dot(-dir, body.support(-dir));
    return width <= kRounding * body.reach();
  };
  // Orientations that differ in every angle; of a law of one orientation all the same.
  const std::array<std::array<double, OrientationLaw::kMaxDimension>, 3> points = {
      {{0.1, 0.2, 0.3, 0.4, 0.55}, {0.9, 0.3, 0.85, 0.15, 0.7}, {0.4, 0.6, 0.05, 0.65, 0.35}}};
  const auto is_flat_always = [&](const auto& axis_in_a) {
    return std::ranges::all_of(points, [&](const auto& point) {
      const Transformd rotation = law.rotation(std::span<const double>(point));
      const Vec3d axis = axis_in_a(rotation);
      return is_flat_along(a, axis) && is_flat_along(b, rotation.direction_to_b(axis));
    });
  };
  for (const Vec3d& axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
    if (is_flat_always([&](const Transformd&) { return axis; })) return true;
    if (is_flat_always([&](const Transformd& rotation) { return rotation(axis); })) return true;
  }
  return law.has_axes() && is_flat_always([&](const Transformd&) { return law.axis_of(0); });
}

Domain best_domain(const ConvexBody& a, const ConvexBody& b) {
  const Domain ball = ball_domain(a, b);
  const Domain box = box_domain(a, b);
  // Of near-balls nearly every trial in the ball hits, and the misses that an error is taken from do not come.
  constexpr double kFewestMisses = 1e-3;
  const double inner = (a.inradius() + b.inradius()) / ball.radius;
  const bool lacks_misses = inner * inner * inner > 1.0 - kFewestMisses && !(is_ball(a) && is_ball(b));
  return box.volume < ball.volume || lacks_misses ? box : ball;
}

}  // namespace vex

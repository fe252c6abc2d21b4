#include "engine/query/packets/quick_verdict.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/query/packets/core_form.h"

namespace vex {
namespace {

// Squares of lengths, and of an ellipsoid's curvatures, neither over- nor underflow where they matter.
bool is_usual(double length) { return length > 0x1p-100 && length < 0x1p100; }

double volume_of_box(const Vec3d& extent) { return extent.x * extent.y * extent.z; }

}  // namespace

QuickVerdict::QuickVerdict(const ConvexBody& a, const ConvexBody& b, double rotation_error)
    : centre_a_(a.centre()),
      centre_b_(b.centre()),
      reach_(norm_1(a.centre()) + 4.0 * norm_1(b.centre()) + a.circumradius() + b.circumradius()) {
  if (!is_usual(reach_) || !is_usual(a.circumradius() + b.circumradius())) return;
  a_ = bounds_of(a, b, rotation_error);
  b_ = bounds_of(b, a, rotation_error);
  a_.error = 32.0 * kUnitRoundoff;
  b_.error = 32.0 * kUnitRoundoff + 4.0 * rotation_error;
  turned_pays_ = b_.kind != Bounds::Kind::balls && b_.kind != Bounds::Kind::none;  // balls have been asked already
}

QuickVerdict::Bounds QuickVerdict::bounds_of(const ConvexBody& body, const ConvexBody& other, double rotation_error) {
  Bounds bounds;
  bounds.centre = body.centre();
  const auto outer_with = [&](double own) {
    return (own + other.circumradius()) * (1.0 + 2.0 * rotation_error) * (1.0 + gamma(24));
  };
  // Centres are points of their bodies up to the support errors alone.
  const auto inner_with = [&](double own) {
    return (own + other.inradius() - other.support_error()) * (1.0 - 2.0 * rotation_error) * (1.0 - gamma(24));
  };
  const std::optional<CoreForm> core = core_form(body);
  if (core && (core->kind == CoreForm::Kind::box || core->kind == CoreForm::Kind::ellipsoid)) {
    bounds.outer = outer_with(body.ball_radius());
    bounds.inner = inner_with(body.ball_radius());
    if (core->kind == CoreForm::Kind::ellipsoid) {
      const Vec3d& axes = core->semi_axes;
      if (is_usual(axes.x) && is_usual(axes.y) && is_usual(axes.z)) {
        bounds.kind = Bounds::Kind::ellipsoid;
        bounds.reciprocal_axes = {1.0 / axes.x, 1.0 / axes.y, 1.0 / axes.z};
        return bounds;
      }
    } else {
      const Vec3d extent = core->upper - core->lower;
      bounds.lower = core->lower;
      bounds.upper = core->upper;
      const bool is_point = extent.x == 0.0 && extent.y == 0.0 && extent.z == 0.0;
      bounds.kind = is_point ? Bounds::Kind::balls : Bounds::Kind::box;
      if (is_point) bounds.centre = core->lower;
      return bounds;
    }
  }
  bounds.outer_ball = outer_with(body.circumradius());
  bounds.inner = inner_with(body.inradius() - body.support_error());
  // The support points along the axes are as far out as the body reaches, but for their error.
  const double error = body.support_error();
  bounds.upper = {body.support({1, 0, 0}).x + error, body.support({0, 1, 0}).y + error,
                  body.support({0, 0, 1}).z + error};
  bounds.lower = {body.support({-1, 0, 0}).x - error, body.support({0, -1, 0}).y - error,
                  body.support({0, 0, -1}).z - error};
  bounds.outer = outer_with(0.0);
  const double ball = 4.18879 * std::pow(body.circumradius(), 3);  // a box that is not much smaller says nothing more
  bounds.kind = volume_of_box(bounds.upper - bounds.lower) < 0.5 * ball ? Bounds::Kind::balls_box : Bounds::Kind::balls;
  if (bounds.kind == Bounds::Kind::balls) bounds.outer = bounds.outer_ball;
  return bounds;
}

}  // namespace vex

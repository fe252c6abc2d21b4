#include "tests/opencl/pair_of_bodies.h"

#include <algorithm>
#include <memory>

#include "engine/numeric/rounding.h"
#include "engine/query/packets/packet_pair.h"
#include "engine/sampling/poses/orientation_law.h"

namespace vex {
namespace {

VexVec vec_of(const Vec3d& v) { return {v.x, v.y, v.z}; }
Vec3d each(const Vec3d& v, double (*f)(double)) { return {f(v.x), f(v.y), f(v.z)}; }
double largest_of(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }
double smallest_of(const Vec3d& v) { return std::min({v.x, v.y, v.z}); }

// Squares of lengths, and of an ellipsoid's curvatures, neither over- nor underflow where they matter (E5).
bool is_usual(double length) { return length > 0x1p-100 && length < 0x1p100; }

// The directions only steer the search: those of an ellipsoid as the core, or in the place of its bounding box.
std::optional<VexCore> core_of(const ConvexBody& body, const CoreForm& form) {
  VexCore core{};
  core.lower = vec_of(form.lower);
  core.upper = vec_of(form.upper);
  const Vec3d extent = form.upper - form.lower;
  if (form.kind == CoreForm::Kind::box) {
    core.kind = VEX_BOX;
    core.has_direction = largest_of(extent) > 0.0;
    return core;
  }
  Vec3d axes = form.semi_axes;
  if (form.kind == CoreForm::Kind::ellipsoid) {
    core.kind = VEX_ELLIPSOID;
    core.semi_axes = vec_of(axes);
  } else {
    const std::optional<ExactForm> exact = body.exact_form();
    if (!exact || !exact->pieces.empty() || exact->points.empty() || exact->points.size() > VEX_MOST_VERTICES)
      return std::nullopt;
    core.kind = VEX_VERTICES;
    core.n_vertices = static_cast<int>(exact->points.size());
    std::transform(exact->points.begin(), exact->points.end(), core.vertices, vec_of);
    core.middle = vec_of(0.5 * (form.lower + form.upper));
    const double least = 0x1p-6 * largest_of(extent);
    axes = {std::max(extent.x, least), std::max(extent.y, least), std::max(extent.z, least)};
  }
  const double shortest = smallest_of(axes);
  const Vec3d weights{shortest / axes.x, shortest / axes.y, shortest / axes.z};
  core.weights = vec_of(each(weights, [](double x) { return x * x; }));
  core.has_direction = smallest_of(weights) < 0.9;
  return core;
}

// As QuickVerdict has them (E5).
std::optional<VexBounds> bounds_of(const ConvexBody& body, const ConvexBody& other, const CoreForm& form) {
  const auto outer_with = [&](double own) {
    return (own + other.circumradius()) * (1.0 + 2.0 * kDrawnRotationError) * (1.0 + gamma(24));
  };
  const auto inner_with = [&](double own) {
    return (own + other.inradius()) * (1.0 - 2.0 * kDrawnRotationError) * (1.0 - gamma(24));
  };
  VexBounds bounds{};
  bounds.centre = vec_of(body.centre());
  bounds.outer_ball = outer_with(body.circumradius());
  if (form.kind == CoreForm::Kind::box || form.kind == CoreForm::Kind::ellipsoid) {
    bounds.outer = outer_with(body.ball_radius());
    bounds.inner = inner_with(body.ball_radius());
    bounds.lower = vec_of(form.lower);
    bounds.upper = vec_of(form.upper);
    bounds.kind = VEX_BOX;
    if (form.kind == CoreForm::Kind::box) return bounds;
    if (!is_usual(smallest_of(form.semi_axes)) || !is_usual(largest_of(form.semi_axes))) return std::nullopt;
    bounds.kind = VEX_ELLIPSOID;
    bounds.reciprocal_axes = vec_of(each(form.semi_axes, [](double x) { return 1.0 / x; }));
    return bounds;
  }
  // The support points along the axes are as far out as the body reaches, but for their error.
  const double error = body.support_error();
  bounds.kind = VEX_VERTICES;
  bounds.upper = {body.support({1, 0, 0}).x + error, body.support({0, 1, 0}).y + error,
                  body.support({0, 0, 1}).z + error};
  bounds.lower = {body.support({-1, 0, 0}).x - error, body.support({0, -1, 0}).y - error,
                  body.support({0, 0, -1}).z - error};
  bounds.outer = outer_with(0.0);
  bounds.inner = inner_with(body.inradius());
  return bounds;
}

}  // namespace

std::optional<VexPair> pair_of_bodies(const ConvexBody& a, const ConvexBody& b, const Domain& domain) {
  if (domain.kind == Domain::Kind::fitted) return std::nullopt;
  const std::unique_ptr<PacketPair> packets = PacketPair::make(a, b);
  if (packets == nullptr) return std::nullopt;
  const PacketPairForms forms = packets->forms();
  if (forms.a->kind == CoreForm::Kind::pieces || forms.b->kind == CoreForm::Kind::pieces) return std::nullopt;
  const std::optional<VexCore> core_a = core_of(a, *forms.a), core_b = core_of(b, *forms.b);
  const double reach = norm_1(a.centre()) + 4.0 * norm_1(b.centre()) + a.circumradius() + b.circumradius();
  if (!core_a || !core_b || !is_usual(reach) || !is_usual(a.circumradius() + b.circumradius())) return std::nullopt;
  const std::optional<VexBounds> bounds_a = bounds_of(a, b, *forms.a), bounds_b = bounds_of(b, a, *forms.b);
  if (!bounds_a || !bounds_b) return std::nullopt;

  VexPair pair{};
  pair.a = *core_a;
  pair.b = *core_b;
  pair.centre_a = vec_of(forms.centre_a);
  pair.centre_b = vec_of(forms.centre_b);
  pair.start = vec_of(forms.centre_a + forms.start_offset);
  pair.ball_radius = forms.ball_radius;
  pair.own_reach = forms.own_reach;
  pair.own_error = forms.own_error;
  pair.bounds_a = *bounds_a;
  pair.bounds_b = *bounds_b;
  pair.bounds_a.error = 32.0 * kUnitRoundoff;
  pair.bounds_b.error = 32.0 * kUnitRoundoff + 4.0 * kDrawnRotationError;
  pair.bounds_reach = reach;
  // Where B is a ball about its centre all has been said by A's bounds.
  pair.asks_bounds_b = !is_ball(b);
  pair.domain_is_ball = domain.kind == Domain::Kind::ball;
  pair.domain_middle = vec_of(domain.middle);
  pair.domain_half_extent = vec_of(domain.half_extent);
  pair.domain_radius = domain.radius;
  return pair;
}

}  // namespace vex

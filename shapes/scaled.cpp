#include "shapes/scaled.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/numeric/rounding.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"

namespace vex {
namespace {

Vec3d times_each(const Vec3d& a, const Vec3d& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3d magnitudes(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
bool is_zero(const Vec3d& v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }

// What was a size and is one no more.
void check_kept(double before, double after) {
  if ((before == 0.0) == (after == 0.0) && std::isfinite(after)) return;
  throw InputError("a size of a scaled body is out of a double's range (" + shortest_number(before) + " becomes " +
                   shortest_number(after) + ") - give factors nearer to 1");
}
Vec3d kept(const Vec3d& before, const Vec3d& after) {
  check_kept(before.x, after.x);
  check_kept(before.y, after.y);
  check_kept(before.z, after.z);
  return after;
}

// A volume or an area that is out of range is not known.
double known_size(double before, double after) {
  const bool is_known = before == 0.0 || (after >= std::numeric_limits<double>::min() && std::isfinite(after));
  return is_known ? after : std::numeric_limits<double>::quiet_NaN();
}

std::optional<ExactForm> scaled_form(std::optional<ExactForm> form, const Vec3d& factors, bool is_even) {
  if (!form) return std::nullopt;
  const Vec3d sizes = magnitudes(factors);
  for (Vec3d& p : form->points) p = kept(p, times_each(factors, p));
  for (ExactForm::Piece& piece : form->pieces) {
    if (piece.is_dome && factors.z < 0.0) return std::nullopt;
    piece.centre = kept(piece.centre, times_each(factors, piece.centre));
    piece.semi_axes = kept(piece.semi_axes, times_each(sizes, piece.semi_axes));
  }
  if (form->ball_radius == 0.0) return form;
  if (is_even) {
    check_kept(form->ball_radius, form->ball_radius * sizes.x);
    form->ball_radius *= sizes.x;
    return form;
  }
  if (!form->pieces.empty()) return std::nullopt;
  // The hull of balls about points is that of their images.
  for (const Vec3d& p : form->points) form->pieces.push_back({p, form->ball_radius * sizes});
  form->points.clear();
  form->ball_radius = 0.0;
  return form;
}

/// F K for F = diag(factors): s(d) = F s_K(F d).
class Scaled {
 public:
  Scaled(const ConvexBody& body, const Vec3d& factors)
      : body_(body), factors_(factors), sizes_(magnitudes(factors)), unit_factors_(scaled_to_unit_exponent(factors)) {
    is_even_ = sizes_.x == sizes_.y && sizes_.y == sizes_.z;
    largest_ = std::max({sizes_.x, sizes_.y, sizes_.z});
    check_kept(body.circumradius(), largest_ * body.circumradius());
    check_kept(body.ball_radius(), largest_ * body.ball_radius());
    form_ = scaled_form(body.exact_form(), factors, is_even_);
  }

  Vec3d support(const Vec3d& dir) const { return times_each(factors_, body_.support(seen(dir))); }
  /// F d is rounded by u of itself, which enters twice, in h_K(F d) and in its product with the point; the point by u
  /// of itself; and what the exact form is rounded besides, by u of its sizes. That is 5 u of the largest factor times
  /// K's reach (E2).
  double support_error() const { return error_of(body_.support_error()); }
  Vec3d centre() const { return times_each(factors_, body_.centre()); }
  double circumradius() const {
    return largest_ * body_.circumradius() * (1.0 + gamma(4)) + 4.0 * kUnitRoundoff * largest_ * body_.reach();
  }
  double inradius() const {
    const double least = std::min({sizes_.x, sizes_.y, sizes_.z});
    return std::max(0.0, least * body_.inradius() * (1.0 - gamma(4)) - 4.0 * kUnitRoundoff * largest_ * body_.reach());
  }

  // A ball that is stretched is none: the core is the whole body then.
  Vec3d core_support(const Vec3d& dir) const {
    return is_even_ ? times_each(factors_, body_.core_support(seen(dir))) : support(dir);
  }
  double core_support_error() const { return is_even_ ? error_of(body_.core_support_error()) : support_error(); }
  double ball_radius() const { return is_even_ ? largest_ * body_.ball_radius() : 0.0; }
  double rolling_radius() const { return is_even_ ? largest_ * body_.rolling_radius() * (1.0 - gamma(4)) : 0.0; }
  std::optional<ExactForm> exact_form() const { return form_; }

 private:
  // At unit exponent, so that nothing of it underflows however unlike the factors are.
  Vec3d seen(const Vec3d& dir) const {
    const Vec3d image = times_each(unit_factors_, dir);
    return is_zero(image) ? image : scaled_to_unit_exponent(image);
  }
  double error_of(double of_body) const {
    return largest_ * (of_body + 8.0 * kUnitRoundoff * body_.reach()) * (1.0 + gamma(4));
  }

  ConvexBody body_;
  Vec3d factors_, sizes_, unit_factors_;
  bool is_even_ = false;
  double largest_ = 0.0;
  std::optional<ExactForm> form_;
};

Measures scaled_measures(const Measures& of_body, const Vec3d& sizes) {
  Measures measures = Measures::unknown();
  measures.volume = known_size(of_body.volume, of_body.volume * (sizes.x * sizes.y * sizes.z));
  if (sizes.x == sizes.y && sizes.y == sizes.z) {
    measures.surface_area = known_size(of_body.surface_area, of_body.surface_area * (sizes.x * sizes.x));
    measures.integrated_mean_curvature =
        known_size(of_body.integrated_mean_curvature, of_body.integrated_mean_curvature * sizes.x);
  }
  return measures;
}

// About the image of the centre the image of the ball inside has a ball, less what rounding moves the vertices.
Polytope polytope_of(const std::vector<Vec3d>& vertices, const Vec3d& centre, double least_stretch,
                     const ConvexBody& body) {
  double largest = 0.0;
  for (const Vec3d& v : vertices) largest = std::max(largest, norm_1(v));
  const double inradius = least_stretch * body.inradius() * (1.0 - gamma(8)) - 8.0 * kUnitRoundoff * largest;
  return {vertices, centre, inradius >= kLeastBodySize ? inradius : 0.0};
}

// Of bodies about the origin whose images are named ones: these know their measures.
std::optional<Body> named_image(const ConvexBody& body, const ExactForm& form, const Vec3d& sizes, bool is_even) {
  const std::optional<Generators>& generators = body.generators();
  if (form.is_polytope() && generators && generators->n_vectors == 3 && is_zero(generators->centre)) {
    const auto& [x, y, z] = generators->vectors;
    if (x.y == 0.0 && x.z == 0.0 && y.x == 0.0 && y.z == 0.0 && z.x == 0.0 && z.y == 0.0) {
      const Vec3d half = magnitudes(times_each(sizes, {x.x, y.y, z.z}));
      Body box = Box(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
      box.kind = "box";
      return box;
    }
  }
  std::optional<Vec3d> semi_axes;
  if (!is_even && form.points.size() == 1 && form.pieces.empty() && form.ball_radius > 0.0 && is_zero(form.points[0])) {
    semi_axes = form.ball_radius * sizes;
  } else if (form.points.empty() && form.pieces.size() == 1 && form.ball_radius == 0.0 && !form.pieces[0].is_dome &&
             is_zero(form.pieces[0].centre)) {
    semi_axes = times_each(sizes, form.pieces[0].semi_axes);
  }
  if (!semi_axes || !(semi_axes->x > 0.0 && semi_axes->y > 0.0 && semi_axes->z > 0.0)) return std::nullopt;
  Body ellipsoid = Ellipsoid(semi_axes->x, semi_axes->y, semi_axes->z);
  ellipsoid.kind = "ellipsoid";
  return ellipsoid;
}

}  // namespace

Body scaled(const Body& body, const Vec3d& factors) {
  for (const double factor : {factors.x, factors.y, factors.z}) {
    if (std::fabs(factor) >= kLeastFactor && std::fabs(factor) <= kLargestFactor) continue;
    throw InputError("a factor of a scaled body is 0, not finite, or out of range (" + shortest_number(factor) +
                     ") - give magnitudes from " + shortest_number(kLeastFactor) + " to " +
                     shortest_number(kLargestFactor));
  }
  const Vec3d sizes = magnitudes(factors);
  const std::optional<ExactForm> form = body.body.exact_form();
  const bool is_even = sizes.x == sizes.y && sizes.y == sizes.z;
  if (form) {
    if (std::optional<Body> named = named_image(body.body, *form, sizes, is_even)) return *std::move(named);
  }
  const Measures measures = scaled_measures(body.measures, sizes);
  const std::string kind = is_even ? body.kind : "scaled " + body.kind;
  if (!form || !form->is_polytope()) {
    return {kind, ConvexBody(Scaled(body.body, factors)), measures, body.n_faces};
  }
  const std::vector<Vec3d> vertices = scaled_form(form, factors, is_even)->points;
  const double least = std::min({sizes.x, sizes.y, sizes.z});
  return {kind, polytope_of(vertices, times_each(factors, body.body.centre()), least, body.body), measures,
          body.n_faces};
}

Body mapped(const Body& polytope, const std::array<Vec3d, 3>& rows) {
  const std::optional<ExactForm> form = polytope.body.exact_form();
  if (!form || !form->is_polytope()) {
    throw InputError("a body under a linear map is no polytope (" + polytope.kind +
                     ") - map a polytope, or scale the body along its axes");
  }
  double size = 0.0;
  for (const Vec3d& row : rows) size = std::max(size, norm_1(row));
  // In units of a power of two near the largest entry, so that a map of any size has a determinant.
  const int unit = std::isfinite(size) && size > 0.0 ? std::ilogb(size) : 0;
  std::array<Vec3d, 3> r = rows;
  for (Vec3d& row : r) row = times_power_of_two(row, -unit);
  const double determinant = dot(r[0], cross(r[1], r[2]));
  // Six products of three numbers and their sums: rounded by less than 16 u of the sum of their magnitudes.
  const Vec3d a = magnitudes(r[0]), b = magnitudes(r[1]), c = magnitudes(r[2]);
  const double products = dot(a, Vec3d{b.y * c.z + b.z * c.y, b.z * c.x + b.x * c.z, b.x * c.y + b.y * c.x});
  if (!std::isfinite(size) || !(std::fabs(determinant) > 16.0 * kUnitRoundoff * products)) {
    throw InputError("a linear map is not finite, or flattens bodies to rounding (its determinant is " +
                     shortest_number(dot(rows[0], cross(rows[1], rows[2]))) + ") - give a matrix that has an inverse");
  }
  const auto image = [&rows](const Vec3d& p) -> Vec3d { return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)}; };
  std::vector<Vec3d> vertices;
  for (const Vec3d& p : form->points) vertices.push_back(image(p));
  Measures measures = Measures::unknown();
  // A map that nearly flattens has nothing left of the products: then neither the determinant nor the vertices, which
  // are rounded, tell the volume.
  constexpr double kLeastShare = 1e-3;
  if (std::fabs(determinant) >= kLeastShare * products) {
    const double volume = polytope.measures.volume;
    measures.volume = known_size(volume, std::ldexp(volume * std::fabs(determinant), 3 * unit));
  }
  return {"mapped " + polytope.kind, polytope_of(vertices, image(polytope.body.centre()), 0.0, polytope.body), measures,
          polytope.n_faces};
}

}  // namespace vex

#include "tests/referees/exact_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/numeric/expect.h"
#include "tests/referees/exact_axes.h"

namespace vex {
namespace exact {
namespace {

Float to_float(const Rational& x) { return Float(numerator(x)) / Float(denominator(x)); }

std::vector<WholePoint> times(const std::vector<Point>& points, const Whole& factor) {
  std::vector<WholePoint> result;
  for (const Point& p : points) {
    WholePoint whole;
    for (std::size_t k = 0; k < 3; ++k) whole[k] = numerator(Rational(p[k] * factor));
    result.push_back(whole);
  }
  return result;
}

Whole common_denominator(const std::vector<Point>& a, const std::vector<Point>& b) {
  Whole common = 1;
  for (const std::vector<Point>* points : {&a, &b}) {
    for (const Point& p : *points) {
      for (const Rational& x : p) common = lcm(common, Whole(denominator(x)));
    }
  }
  return common;
}

// h_K(axis) and axis^2: the depth along the axis is h / |axis|.
struct Width {
  Whole h, axis_sq;
  WholePoint axis;
};

bool less(const Width& a, const Width& b) { return a.h * a.h * b.axis_sq < b.h * b.h * a.axis_sq; }

}  // namespace

Deepest deepest(const std::vector<Point>& a, const std::vector<Point>& b) {
  const Whole factor = common_denominator(a, b);
  const std::vector<WholePoint> whole_a = times(a, factor), whole_b = times(b, factor);
  std::optional<Width> least;
  bool separated = false;
  for_each_axis(whole_a, whole_b, [&](const WholePoint& axis) {
    const Extent of_a = extent_along(axis, whole_a), of_b = extent_along(axis, whole_b);
    const Whole axis_sq = inner(axis, axis);
    const Width forwards{of_a.largest - of_b.least, axis_sq, axis};
    const Width backwards{of_b.largest - of_a.least, axis_sq, {-axis[0], -axis[1], -axis[2]}};
    separated = forwards.h < 0 || backwards.h < 0;
    for (const Width& width : {forwards, backwards}) {
      if (!least || less(width, *least)) least = width;
    }
    return !separated;
  });
  if (separated) {
    std::vector<Point> differences;
    for (const Point& p : a) {
      for (const Point& q : b) differences.push_back(minus(q, p));
    }
    const Point nearest = nearest_to_origin(differences);
    return {sqrt(to_float(inner(nearest, nearest))), nearest};
  }
  if (!least) return {0, {}};  // one and the same point
  const Point direction{Rational(least->axis[0]), Rational(least->axis[1]), Rational(least->axis[2])};
  if (dimension_of_difference(whole_a, whole_b) < 3) return {0, direction};
  return {-Float(least->h) / (sqrt(Float(least->axis_sq)) * Float(factor)), direction};
}

namespace {

using Vector = std::array<Float, 3>;

Float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector to_float(const Point& p) { return {to_float(p[0]), to_float(p[1]), to_float(p[2])}; }

// {c + M x : |x| <= 1}, of a dome only where x_z >= 0; M by columns.
struct PlacedPiece {
  Vector centre;
  std::array<Vector, 3> columns;
  bool is_dome = false;

  Vector support(const Vector& dir) const {
    Vector image;
    for (std::size_t k = 0; k < 3; ++k) image[k] = dot(columns[k], dir);
    if (is_dome && image[2] < 0) image[2] = 0;
    const Float length = sqrt(dot(image, image));
    Vector point = centre;
    if (length == 0) return point;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) point[i] += columns[k][i] * image[k] / length;
    }
    return point;
  }
};

// A body in A's frame, without its ball.
struct PlacedForm {
  std::vector<Point> points;
  std::vector<PlacedPiece> pieces;
  Rational ball_radius;
};

Point placed_exactly(const Vec3d& p, const Transformd& pose) {
  const Point at = exactly(p), t = exactly(pose.translation);
  return {inner(exactly(pose.row_x), at) + t[0], inner(exactly(pose.row_y), at) + t[1],
          inner(exactly(pose.row_z), at) + t[2]};
}

PlacedForm placed_form(const ConvexBody& body, const Transformd& pose) {
  const ExactForm form = body.exact_form().value();
  PlacedForm placed{{}, {}, Rational(form.ball_radius)};
  for (const Vec3d& p : form.points) {
    placed.points.push_back(form.is_polytope() ? exactly(pose(p)) : placed_exactly(p, pose));
  }
  for (const ExactForm::Piece& piece : form.pieces) {
    PlacedPiece own{to_float(placed_exactly(piece.centre, pose)), {}, piece.is_dome};
    const double axes[] = {piece.semi_axes.x, piece.semi_axes.y, piece.semi_axes.z};
    const Vec3d columns[] = {{pose.row_x.x, pose.row_y.x, pose.row_z.x},
                             {pose.row_x.y, pose.row_y.y, pose.row_z.y},
                             {pose.row_x.z, pose.row_y.z, pose.row_z.z}};
    for (std::size_t k = 0; k < 3; ++k) {
      own.columns[k] = {Float(columns[k].x) * axes[k], Float(columns[k].y) * axes[k], Float(columns[k].z) * axes[k]};
    }
    placed.pieces.push_back(own);
  }
  return placed;
}

Float height(const PlacedForm& form, const Vector& dir) {
  std::optional<Float> most;
  const auto take = [&](const Vector& point) {
    const Float value = dot(point, dir);
    if (!most || value > *most) most = value;
  };
  for (const Point& p : form.points) take(to_float(p));
  for (const PlacedPiece& piece : form.pieces) take(piece.support(dir));
  return most.value();
}

Vector opposite(const Vector& dir) { return {-dir[0], -dir[1], -dir[2]}; }

// Points of the body but for the rounding to multiples of `grain`: enough of each piece to span it, then, call by
// call, the support points that were missed.
class InnerHull {
 public:
  InnerHull(const PlacedForm& form, const Float& grain) : form_(form), grain_(grain), points_(form.points) {
    for (std::size_t k = 0; k < 3 && !form.pieces.empty(); ++k) {
      Vector dir{};
      dir[k] = 1;
      add_support(dir);
      add_support(opposite(dir));
    }
  }
  void add_support(const Vector& dir) {
    for (const PlacedPiece& piece : form_.pieces) {
      const Vector s = piece.support(dir);
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = Rational(Whole(round(s[k] / grain_))) * rational_grain();
      if (std::find(points_.begin(), points_.end(), p) == points_.end()) points_.push_back(p);
    }
  }
  const std::vector<Point>& points() const { return points_; }

 private:
  Rational rational_grain() const {
    const int exponent = ilogb(grain_);
    return exponent >= 0 ? Rational(Whole(1) << exponent) : Rational(Whole(1), Whole(1) << -exponent);
  }
  const PlacedForm& form_;
  Float grain_;
  std::vector<Point> points_;
};

SignedDistance between(const Float& lower, const Float& upper) {
  const Float middle = (lower + upper) / 2;
  const double value = middle.convert_to<double>();
  const Float error = std::max(Float(upper - value), Float(value - lower));
  return {value, std::nextafter(error.convert_to<double>(), std::numeric_limits<double>::infinity())};
}

}  // namespace
}  // namespace exact

SignedDistance exact_signed_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b) {
  using exact::Float;
  // A stays where it is: under the identity no vertex of it is rounded.
  const exact::PlacedForm form_a = exact::placed_form(a, {}), form_b = exact::placed_form(b, a_from_b);
  const Float radii = exact::to_float(exact::Rational(form_a.ball_radius + form_b.ball_radius));
  if (form_a.pieces.empty() && form_b.pieces.empty()) {
    const Float signed_distance = exact::deepest(form_a.points, form_b.points).signed_distance - radii;
    const Float rounding = 1e-80 * (abs(signed_distance) + radii);  // of sums of a hundred digits
    return exact::between(signed_distance - rounding, signed_distance + rounding);
  }
  const double size = a.reach() + b.reach();
  const Float grain = ldexp(Float(1), std::ilogb(size) - 160);
  exact::InnerHull inner_a(form_a, grain), inner_b(form_b, grain);
  const Float unbounded = std::numeric_limits<double>::infinity();
  Float lower = -unbounded, upper = unbounded;
  constexpr int kMaxRounds = 40;
  for (int round = 0; round < kMaxRounds && !(upper - lower <= 1e-22 * size); ++round) {
    const exact::Deepest inside = exact::deepest(inner_a.points(), inner_b.points());
    const exact::Vector dir = exact::to_float(inside.direction), back = exact::opposite(dir);
    const Float length = sqrt(exact::dot(dir, dir));
    if (length == 0) break;
    // A multiple of the grain moves either hull by no more than its diagonal.
    upper = std::min(upper, Float(inside.signed_distance + 4 * grain));
    const Float width = exact::height(form_a, dir) + exact::height(form_b, back);
    lower = std::max(lower, Float(-width / length - grain));
    inner_a.add_support(dir);
    inner_b.add_support(back);
  }
  return exact::between(lower - radii, upper - radii);
}

SignedDistance ellipsoid_signed_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                         const Vec3d& normal) {
  using exact::Float;
  using exact::Vector;
  const exact::PlacedForm form_a = exact::placed_form(a, {}), form_b = exact::placed_form(b, a_from_b);
  Vector dir{normal.x, normal.y, normal.z};
  const Float length = sqrt(exact::dot(dir, dir));
  for (Float& x : dir) x /= length;

  // p is the support point of K = A - B, h its height, and `aside` what of p is not along the direction.
  Vector p{};
  Float rolling_radius = 0;
  double radii = 0.0;
  const auto take = [&](const exact::PlacedForm& form, const ConvexBody& body, const Vector& out, int sign) {
    const ExactForm exact_form = body.exact_form().value();
    radii += exact_form.ball_radius;
    Vector point{};
    if (form.pieces.empty()) {
      VEX_EXPECT(form.points.size() == 1);
      point = exact::to_float(form.points[0]);
    } else {
      VEX_EXPECT(form.pieces.size() == 1 && form.points.empty());
      point = form.pieces[0].support(out);
      const Vec3d axes = exact_form.pieces[0].semi_axes;
      const Float least = std::min({axes.x, axes.y, axes.z}), most = std::max({axes.x, axes.y, axes.z});
      rolling_radius += least * least / most * (1.0 - 1e-5);  // R is a rotation to within 1e-6
    }
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] += sign * (point[k] + exact_form.ball_radius * out[k]);
    }
  };
  take(form_a, a, dir, 1);
  take(form_b, b, exact::opposite(dir), -1);
  rolling_radius += radii;

  // An ellipsoid is the sum of a ball of radius a_min^2 / a_max, its least radius of curvature, and another convex
  // body (W. Blaschke, Kreis und Kugel, section 24), and K of balls of both radii: a ball of radius rho within K
  // touches its surface at p. Its centre, p - rho n, is sqrt((rho - h)^2 + aside^2) from the origin.
  const Float h = exact::dot(p, dir);
  if (h >= rolling_radius) return {-h.convert_to<double>(), std::numeric_limits<double>::infinity()};
  Float aside_sq = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Float aside = p[k] - h * dir[k];
    aside_sq += aside * aside;
  }
  const Float rounding = 1e-80 * (a.reach() + b.reach() + norm(a_from_b.translation));
  return exact::between(-h - rounding, -h + aside_sq / (2 * (rolling_radius - h)) + rounding);
}

}  // namespace vex

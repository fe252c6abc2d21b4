#include "engine/query/packets/pair_formula.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

bool is_segment(const Vec3d& half) { return (half.x > 0.0) + (half.y > 0.0) + (half.z > 0.0) <= 1; }

double inverse_square(const Vec3d& half) {
  const double square = dot(half, half);
  return square > 0.0 ? 1.0 / square : 0.0;
}

PairFormula formula_of_boxes(const CoreForm& a, const CoreForm& b, double ball_radius) {
  PairFormula formula;
  formula.centre_a = 0.5 * (a.lower + a.upper);
  formula.centre_b = 0.5 * (b.lower + b.upper);
  formula.half_a = 0.5 * (a.upper - a.lower);
  formula.half_b = 0.5 * (b.upper - b.lower);
  if (ball_radius == 0.0) {
    formula.kind = PairFormula::Kind::boxes;
  } else if (is_segment(formula.half_a) && is_segment(formula.half_b)) {
    formula.kind = PairFormula::Kind::segments;
    formula.inverse_a = inverse_square(formula.half_a);
    formula.inverse_b = inverse_square(formula.half_b);
  }
  return formula;
}

PairFormula formula_of_ellipsoids(const Vec3d& a, const Vec3d& b, double reach) {
  constexpr double kThinnest = 0x1p-12;
  const double longest = std::max({a.x, a.y, a.z, b.x, b.y, b.z}), shortest = std::min({a.x, a.y, a.z, b.x, b.y, b.z});
  PairFormula formula;
  if (!(shortest >= kThinnest * longest)) return formula;
  formula.kind = PairFormula::Kind::ellipsoids;
  formula.unit = std::ldexp(1.0, -std::ilogb(longest));
  const Vec3d axes_a = formula.unit * a;
  formula.axes_b = formula.unit * b;
  formula.squares_a = {axes_a.x * axes_a.x, axes_a.y * axes_a.y, axes_a.z * axes_a.z};
  // With these two balls of such volumes touch where both are reached at once.
  const double of_a = std::cbrt(axes_a.x * axes_a.y * axes_a.z);
  const double of_b = std::cbrt(formula.axes_b.x * formula.axes_b.y * formula.axes_b.z);
  formula.share_a = of_b / (of_a + of_b);
  formula.share_b = of_a / (of_a + of_b);
  formula.least_determinant =
      0x1p8 * kUnitRoundoff * std::pow(formula.unit * longest, 6) * (reach / shortest) / PairFormula::kMargin;
  return formula;
}

}  // namespace

PairFormula pair_formula(const CoreForm& a, const CoreForm& b, double ball_radius, double reach) {
  if (a.kind != b.kind) return {};
  if (a.kind == CoreForm::Kind::box) return formula_of_boxes(a, b, ball_radius);
  if (a.kind == CoreForm::Kind::ellipsoid && ball_radius == 0.0) {
    return formula_of_ellipsoids(a.semi_axes, b.semi_axes, reach);
  }
  return {};
}

}  // namespace vex

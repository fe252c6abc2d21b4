#include "meshes/determinant.h"

#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// Counting double-double roundings (Joldes, Muller, Popescu: a product 7 u^2, a sum 3 u^2, to first order): each factor
// may be a difference of its own, 3; a minor 7 + 3, its product with the third factor 7, two sums 3 + 3; with three
// factors 32 u^2 times the permanent. 40 leaves room for the second order, for the permanent's own rounding and for
// value() rounding the result.
constexpr double kErrorPerPermanent = 40.0 * kUnitRoundoff * kUnitRoundoff;

}  // namespace

double norm(const DoubleDoubleVec3& v) { return std::sqrt(dot(v, v).value()); }

BoundedDeterminant determinant(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b, const DoubleDoubleVec3& c) {
  return {dot(a, cross(b, c)), kErrorPerPermanent * permanent(a.value(), b.value(), c.value())};
}

BoundedDeterminant orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return determinant(exact_difference(b, a), exact_difference(c, a), exact_difference(d, a));
}

}  // namespace vex

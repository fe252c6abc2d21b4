// Differences, cross products and 3x3 determinants in double-double, with a bound on what rounding left.
//
// Coordinates are floats promoted to double, so a product of three differences needs up to 3 * 53 bits; double-double
// keeps 106 of them, and the determinant's error is bounded by its permanent (the same sum, of magnitudes). Magnitudes
// stay far from over- and underflow: with |coordinate| <= 2^128 everything here is below 2^900, and the least nonzero
// float 2^-149 cubed keeps its low part above 2^-700.
#pragma once

#include <array>
#include <cmath>

#include "engine/numeric/double_double.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// A vector in double-double.
struct DoubleDoubleVec3 {
  DoubleDouble x, y, z;

  Vec3d value() const { return {x.value(), y.value(), z.value()}; }
};

/// a - b exactly.
inline DoubleDoubleVec3 exact_difference(const Vec3d& a, const Vec3d& b) {
  return {two_sum(a.x, -b.x), two_sum(a.y, -b.y), two_sum(a.z, -b.z)};
}

inline DoubleDoubleVec3 operator-(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline DoubleDoubleVec3 operator+(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// Each coordinate has an absolute error of at most 10 u^2 times the sum of its two products' magnitudes.
inline DoubleDoubleVec3 cross(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline DoubleDouble dot(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// sqrt(v . v), in double: a relative error of at most a few u.
double norm(const DoubleDoubleVec3& v);

/// The permanent of a, b, c: the determinant's sum, of magnitudes.
inline double permanent(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return std::fabs(a.x) * (std::fabs(b.y * c.z) + std::fabs(b.z * c.y)) +
         std::fabs(a.y) * (std::fabs(b.z * c.x) + std::fabs(b.x * c.z)) +
         std::fabs(a.z) * (std::fabs(b.x * c.y) + std::fabs(b.y * c.x));
}

/// det(a, b, c) in double, its three products summed in the order of the permanent.
inline double rough_determinant(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

/// Below it a product of the permanent's may have come near to underflow.
inline constexpr double kLeastSurePermanent = 0x1p-960;

/// The sign of det(a, b, c) where double alone is sure of it, although each coordinate may be off by up to 2 u of
/// itself; 0 where it is not. With the determinant's own five roundings the error is at most gamma(11) times the
/// permanent, whose own roundings are within gamma(16). A sign that is sure is one by ten u of the permanent and more:
/// double-double, which errs by u^2, sees it too.
inline int sure_determinant_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double det = rough_determinant(a, b, c);
  const double magnitude = permanent(a, b, c);
  if (magnitude > kLeastSurePermanent && std::fabs(det) > gamma(24) * magnitude + 0x1p-1020) {
    return det > 0.0 ? 1 : -1;
  }
  return 0;
}

/// A determinant and how far from the true one it can be.
struct BoundedDeterminant {
  DoubleDouble value;
  double error = 0.0;

  bool surely_positive() const { return value.value() > error; }
  bool surely_negative() const { return value.value() < -error; }
};

/// det(a, b, c) = a . (b x c).
BoundedDeterminant determinant(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b, const DoubleDoubleVec3& c);

/// det(b - a, c - a, d - a): six times the volume of the tetrahedron, positive where d lies above the plane of a, b, c
/// seen counter-clockwise.
BoundedDeterminant orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

}  // namespace vex

#include "shapes/estimators/ellipsoid_excluded_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/support/checked_input.h"

namespace vex {
namespace {

double determinant_of(const Vec3d& axes) { return axes.x * axes.y * axes.z; }

/// Carlson's symmetric integral of 0 <= x <= y <= z.
///
/// 2 R_G = y R_F + (y - x)(z - y) R_D(z, x, y) / 3 + sqrt(x z / y) (DLMF 19.21.10, the middle argument in the special
/// place: no term is negative). R_F and R_D by duplication, in one loop: the arguments approach one another, each time
/// by a factor of four; where they are so near that what is left out of the series is below 2^-53, the series
/// (B. C. Carlson, Numer. Algorithms 10, 13, 1995).
double symmetric_integral(double x, double y, double z) {
  if (!(y > 0.0)) return 0.5 * std::sqrt(z);
  const double last = std::sqrt(x * z / y);
  double u = z, v = x, w = y;  // w in the special place
  double sum = 0.0, power = 1.0;
  // What R_D's series leaves out is of the sixth degree: 2^-55 to the power of a sixth is 1/574, about its own mean of
  // the arguments, which is off this one by less than half of what they are.
  constexpr double kNear = 1.0 / 1000.0;
  for (;;) {
    const double mean = ((u + v) + w) * (1.0 / 3.0);
    const double apart = std::max({std::fabs(u - mean), std::fabs(v - mean), std::fabs(w - mean)});
    if (!(apart > kNear * mean)) break;  // or they are no numbers
    const double root_u = std::sqrt(u), root_v = std::sqrt(v), root_w = std::sqrt(w);
    const double lambda = root_u * (root_v + root_w) + root_v * root_w;
    sum += power / (root_w * (w + lambda));
    power *= 0.25;
    u = 0.25 * (u + lambda);
    v = 0.25 * (v + lambda);
    w = 0.25 * (w + lambda);
  }
  double r_f = 0.0, r_d = 0.0;
  {
    const double mean = ((u + v) + w) * (1.0 / 3.0);
    const double a = 1.0 - u / mean, b = 1.0 - v / mean, c = -(a + b);
    const double e2 = a * b - c * c, e3 = a * b * c;
    r_f = (1.0 + (e2 * (e2 * (1.0 / 24.0) - 0.1 - e3 * (3.0 / 44.0)) + e3 * (1.0 / 14.0))) / std::sqrt(mean);
  }
  {
    const double mean = ((u + v) + 3.0 * w) * 0.2;
    const double a = 1.0 - u / mean, b = 1.0 - v / mean, c = -(a + b) * (1.0 / 3.0);
    const double ab = a * b, cc = c * c;
    const double e2 = ab - 6.0 * cc, e3 = (3.0 * ab - 8.0 * cc) * c, e4 = 3.0 * (ab - cc) * cc, e5 = ab * cc * c;
    const double series = 1.0 - e2 * (3.0 / 14.0) + e3 * (1.0 / 6.0) + e2 * e2 * (9.0 / 88.0) - e4 * (3.0 / 22.0) -
                          e2 * e3 * (9.0 / 52.0) + e5 * (3.0 / 26.0);
    r_d = 3.0 * sum + power * series / (mean * std::sqrt(mean));
  }
  return 0.5 * ((y * r_f + (y - x) * (z - y) * r_d * (1.0 / 3.0)) + last);
}

/// In ascending order, each within some roundings of the largest: Jacobi's rotations.
std::array<double, 3> eigenvalues_of(double xx, double yy, double zz, double xy, double xz, double yz) {
  // Turns p and q so that pq becomes 0; r is the third axis.
  const auto rotate = [](double& pp, double& qq, double& pq, double& pr, double& qr) {
    if (pq == 0.0) return;
    const double half = 0.5 * (qq - pp);
    const double tan = pq / (half + std::copysign(std::sqrt(half * half + pq * pq), half));
    const double cos = 1.0 / std::sqrt(1.0 + tan * tan), sin = tan * cos;
    pp -= tan * pq;
    qq += tan * pq;
    pq = 0.0;
    const double old = pr;
    pr = cos * old - sin * qr;
    qr = sin * old + cos * qr;
  };
  // Quadratic at the end: three or four rounds; what they leave moves an eigenvalue by less than 2^-53 of the trace.
  constexpr int kMostRounds = 12;
  for (int round = 0; round < kMostRounds; ++round) {
    rotate(xx, yy, xy, xz, yz);
    rotate(xx, zz, xz, xy, yz);
    rotate(yy, zz, yz, xy, xz);
    if (std::fabs(xy) + std::fabs(xz) <= 0x1p-54 * (xx + yy + zz)) break;
  }
  std::array<double, 3> values{xx, yy, zz};
  std::ranges::sort(values);
  for (double& value : values) value = std::max(value, 0.0);
  return values;
}

/// det D_K * 4 pi R_G(squares of the singular values of m), m = D_K^-1 R D_L with these rows.
double mixed_volume(const Vec3d& axes_k, const Vec3d& x, const Vec3d& y, const Vec3d& z) {
  const auto [low, middle, high] = eigenvalues_of(dot(x, x), dot(y, y), dot(z, z), dot(x, y), dot(x, z), dot(y, z));
  return determinant_of(axes_k) * 4.0 * std::numbers::pi * symmetric_integral(low, middle, high);
}

Vec3d row_of(double divisor, const Vec3d& row, const Vec3d& factors) {
  return {row.x * factors.x / divisor, row.y * factors.y / divisor, row.z * factors.z / divisor};
}

double volume_of(const Vec3d& a, const Vec3d& b, const Transformd& rotation) {
  const auto& [x, y, z, unused] = rotation;
  return 4.0 / 3.0 * std::numbers::pi * (determinant_of(a) + determinant_of(b)) +
         mixed_volume(a, row_of(a.x, x, b), row_of(a.y, y, b), row_of(a.z, z, b)) +
         mixed_volume(b, row_of(b.x, {x.x, y.x, z.x}, a), row_of(b.y, {x.y, y.y, z.y}, a),
                      row_of(b.z, {x.z, y.z, z.z}, a));
}

}  // namespace

double ellipsoid_excluded_volume(const Vec3d& semi_axes_a, const Vec3d& semi_axes_b, const Transformd& rotation) {
  const Vec3d &a = semi_axes_a, &b = semi_axes_b;
  for (const Vec3d& axes : {a, b}) {
    for (const double axis : {axes.x, axes.y, axes.z}) checked_size(axis, "a semi-axis of an ellipsoid");
  }
  const double volume = volume_of(a, b, rotation);
  if (std::isfinite(volume)) return volume;
  throw InputError("an excluded volume of ellipsoids is beyond a double - choose another unit of length");
}

}  // namespace vex

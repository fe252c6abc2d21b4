#include "shapes/superellipsoid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/support/checked_input.h"
#include "shapes/superellipsoid_normals.h"

namespace vex {
namespace {

double checked_exponent(double exponent) {
  if (!(exponent >= 0.5 && exponent <= 1000.0)) {
    throw InputError(
        "an exponent of a superellipsoid is not from 0.5 to 1000 - below it is not convex, and above it is a box or a "
        "cylinder to 1e-3");
  }
  return 2.0 * exponent;
}

/// Gamma(1 + x).
double factorial(double x) { return std::tgamma(1.0 + x); }

/// (a^n + b^n)^(1/n) of positive a and b; the larger of them for n infinite.
double power_sum(double a, double b, double n) {
  const double largest = std::max(a, b), ratio = std::min(a, b) / largest;
  if (std::isinf(n)) return largest;
  return largest * std::pow(1.0 + std::pow(ratio, n), 1.0 / n);
}

// Of the point whose |x/a|^p + |y/b|^p is s^p, with the part t of that in x, and whose |z/c|^q is sigma = 1 - s^q, t
// and sigma are independent under the cone measure (the share of the body's volume that lies behind a part of its
// surface): t has the density t^(a-1) (1-t)^(a-1) / B(a, a), a = 1/p, and sigma sigma^(b-1) (1-sigma)^(2b-1) / B(b,
// 2b), b = 1/q, by Dirichlet's integrals. The gradient of the norm there, a point of the dual body's surface along the
// normal, is
//   d = (t^(1/p') r / a, (1-t)^(1/p') r / b, sigma^(1/q') / c),   r = (1-sigma)^(1/q'),  1/p + 1/p' = 1/q + 1/q' = 1,
// and the height of the body there is 1/|d|. Behind an element of surface dA is the volume dA / 3|d|: S = 3 V <|d|>.
// The dual body is that of p' and q' with semi-axes 1/a, 1/b, 1/c, so d has the same densities with a = 1/p', b = 1/q'
// under its cone measure, behind the solid angle dw lies the volume dw |d|^3 / 3, and M is the integral of 1/|d| over
// w: M = 3 V* <1/|d|^4>.
struct Densities {
  double a, b;                  // 1/p and 1/q of the body whose cone measure it is
  double ta, tb;                // what t and sigma are raised to, 1/p' and 1/q' of the first body ...
  double ta_over_a, tb_over_b;  // ... and that over a and b, which may both be 0

  double volume() const {  // of semi-axes 1
    return 8.0 * factorial(a) * factorial(a) / factorial(2.0 * a) * factorial(b) * factorial(2.0 * b) /
           factorial(3.0 * b);
  }
};

/// Nodes of a mean over t or sigma.
struct Node {
  double first, second;  // t^ta and (1 - t)^ta; of y = t^a the former is y^(ta/a)
  double weight;
};

/// Both halves of (0, 1), each in a power of t or 1 - t in which the density has no pole, by the double exponential
/// rule of this step: what is left of algebraic singularities is at the ends.
class Nodes {
 public:
  explicit Nodes(double step) : step_(step) {}

  /// Of t: symmetric.
  std::vector<Node> of_part(const Densities& of) const {
    const double norm = 2.0 * factorial(of.a) * factorial(of.a) / factorial(2.0 * of.a);  // a B(a, a)
    std::vector<Node> nodes;
    add(of.a, [&](double t, double y, double w) {
      const double low = std::pow(y, of.ta_over_a), high = std::pow(1.0 - t, of.ta);
      const double weight = w * std::pow(1.0 - t, of.a - 1.0) / norm;
      nodes.push_back({low, high, weight});
      nodes.push_back({high, low, weight});
    });
    return nodes;
  }
  /// Of sigma.
  std::vector<Node> of_height(const Densities& of) const {
    const double norm = 1.5 * factorial(of.b) * factorial(2.0 * of.b) / factorial(3.0 * of.b);  // b B(b, 2b)
    std::vector<Node> nodes;
    add(of.b, [&](double t, double y, double w) {
      const double low = std::pow(y, of.tb_over_b), high = std::pow(1.0 - t, of.tb);
      nodes.push_back({low, high, w * std::pow(1.0 - t, 2.0 * of.b - 1.0) / norm});
      nodes.push_back({high, low, w * y * std::pow(1.0 - t, of.b - 1.0) / norm});
    });
    return nodes;
  }

 private:
  /// t = y^(1/e), y from 0 to 2^-e; of e = 0, where y = 1 is t = 1/2, the limit.
  template <class F>
  void add(double e, const F& f) const {
    const double end = std::exp2(-e);
    for (const UnitNode& node : unit_nodes(step_)) {
      const double y = end * node.u, weight = end * node.weight;
      if (weight > 0.0 && y > 0.0) f(e > 0.0 ? std::min(0.5, std::pow(y, 1.0 / e)) : 0.0, y, weight);
    }
  }

  double step_;
};

/// <f(|d|^2)> with d in units in which the dual body's semi-axes are `inverse`.
template <class F>
double mean_over(const Densities& of, const Vec3d& inverse, double step, const F& f) {
  const Nodes nodes(step);
  const std::vector<Node> parts = nodes.of_part(of), heights = nodes.of_height(of);
  std::vector<double> plane_sq;
  for (const Node& part : parts) {
    plane_sq.push_back(part.first * part.first * inverse.x * inverse.x +
                       part.second * part.second * inverse.y * inverse.y);
  }
  DoubleDouble sum;
  for (const Node& height : heights) {
    const double axis_sq = height.first * height.first * inverse.z * inverse.z,
                 shrink_sq = height.second * height.second;
    double inner = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) inner += parts[i].weight * f(shrink_sq * plane_sq[i] + axis_sq);
    sum += height.weight * inner;
  }
  return sum.value();
}

/// Half the step about doubles the right digits.
template <class F>
double settled_mean_over(const Densities& of, const Vec3d& inverse, const F& f) {
  double before = mean_over(of, inverse, 0.125, f);
  for (const double step : {1.0 / 16, 1.0 / 32, 1.0 / 64}) {
    const double mean = mean_over(of, inverse, step, f);
    if (std::fabs(mean - before) <= 1e-9 * mean) return mean;
    before = mean;
  }
  throw InputError(
      "the surface area and the mean curvature of a superellipsoid are not found to 1e-12 (its semi-axes or exponents "
      "are too far apart) - choose less extreme ones, or make a mesh of it");
}

}  // namespace

Superellipsoid::Curve::Curve(double exponent)
    : p(checked_exponent(exponent)), inverse(1.0 / p), power(1.0 / (p - 1.0)) {}

Superellipsoid::Curve::Farthest Superellipsoid::Curve::farthest(double u, double v) const {
  const double largest = std::max(u, v);
  if (!(largest > 0.0)) return {0.0, 0.0, 0.0};
  const double ratio = std::min(u, v) / largest;
  const double beside = std::pow(ratio, power);
  const double reach = std::pow(1.0 + ratio * beside, inverse);
  const double far = 1.0 / reach, near = beside / reach;
  const double height = largest * (far + ratio * near);
  return u >= v ? Farthest{far, near, height} : Farthest{near, far, height};
}

Superellipsoid::Superellipsoid(double semi_axis_x, double semi_axis_y, double semi_axis_z, double exponent_across,
                               double exponent_along)
    : axes_{checked_size(semi_axis_x, "a semi-axis of a superellipsoid"),
            checked_size(semi_axis_y, "a semi-axis of a superellipsoid"),
            checked_size(semi_axis_z, "a semi-axis of a superellipsoid")},
      across_(exponent_across),
      along_(exponent_along) {
  circumradius_ = largest_reach() * (1.0 + gamma(64));
  inradius_ = least_reach() * (1.0 - gamma(64));
}

Vec3d Superellipsoid::support(const Vec3d& dir) const {
  const Vec3d unit = scaled_to_unit_exponent(dir), scaled_axes = scaled_to_unit_exponent(axes_);
  const double x = scaled_axes.x * std::fabs(unit.x), y = scaled_axes.y * std::fabs(unit.y);
  const double z = scaled_axes.z * std::fabs(unit.z);
  const Curve::Farthest plane = across_.farthest(x, y), whole = along_.farthest(plane.height, z);
  return {std::copysign(axes_.x * (plane.u * whole.u), dir.x), std::copysign(axes_.y * (plane.v * whole.u), dir.y),
          std::copysign(axes_.z * whole.v, dir.z)};
}

/// The largest Euclidean norm of (a u, b v) on the unit curve of p is the norm of (a, b) with the exponent 2p/(p - 2),
/// the larger of them for p <= 2; so in the plane, and then with the axis.
double Superellipsoid::largest_reach() const {
  const auto largest = [](double a, double b, double p) {
    return p > 2.0 ? power_sum(a, b, 2.0 * p / (p - 2.0)) : std::max(a, b);
  };
  return largest(largest(axes_.x, axes_.y, across_.p), axes_.z, along_.p);
}

/// The least height, the norm of (a u, b v) with the exponent p' over the unit circle, is one over the norm of (1/a,
/// 1/b) with the exponent 2p/(2 - p), and the lesser of a and b for p >= 2.
double Superellipsoid::least_reach() const {
  const auto least = [](double a, double b, double p) {
    if (p >= 2.0) return std::min(a, b);
    const double smaller = std::min(a, b);
    return smaller / power_sum(1.0, smaller / std::max(a, b), 2.0 * p / (2.0 - p));
  };
  return least(least(axes_.x, axes_.y, across_.p), axes_.z, along_.p);
}

Measures Superellipsoid::measures() const {
  const double a = across_.inverse, b = along_.inverse, dual_a = 1.0 - a, dual_b = 1.0 - b;
  const Densities of_body{a, b, dual_a, dual_b, across_.p - 1.0, along_.p - 1.0};
  const Densities of_dual{dual_a, dual_b, dual_a, dual_b, 1.0, 1.0};
  const double unit = std::max({axes_.x, axes_.y, axes_.z});
  const double x = axes_.x / unit, y = axes_.y / unit, z = axes_.z / unit;
  const Vec3d inverse{1.0 / x, 1.0 / y, 1.0 / z};
  const double area = settled_mean_over(of_body, inverse, [](double d_sq) { return std::sqrt(d_sq); });
  // Of the dual body t^(1/p') is the coordinate itself.
  const double curvature = settled_mean_over(of_dual, inverse, [](double d_sq) { return 1.0 / (d_sq * d_sq); });
  return {of_body.volume() * axes_.x * axes_.y * axes_.z, 3.0 * of_body.volume() * (x * y * z) * area * unit * unit,
          3.0 * of_dual.volume() / (x * y * z) * curvature * unit};
}

NormalMeasure Superellipsoid::area_measure() const {
  NormalMeasure area;
  area.add(
      SuperellipsoidNormals{axes_, across_.p, along_.p, SuperellipsoidNormals::Part::area, measures().surface_area});
  return area;
}

/// Which share of M is whose comes from the measures themselves; only how nodes are spread hangs on it.
NormalMeasure Superellipsoid::mean_curvature_measure() const {
  SuperellipsoidNormals across{axes_, across_.p, along_.p, SuperellipsoidNormals::Part::curvature_across};
  SuperellipsoidNormals along{axes_, across_.p, along_.p, SuperellipsoidNormals::Part::curvature_along};
  across.mass = total_weight(across);
  along.mass = total_weight(along);
  const double mean_curvature = measures().integrated_mean_curvature;
  across.mass *= mean_curvature / (across.mass + along.mass);
  along.mass = mean_curvature - across.mass;
  NormalMeasure curvature;
  curvature.add(across);
  curvature.add(along);
  return curvature;
}

/// Dirichlet's integrals of x^2 over the plane's curve, and of the fourth and second powers of what is left of it along
/// the axis.
SolidMoments Superellipsoid::solid_moments() const {
  const double a = across_.inverse, b = along_.inverse;
  const double product = axes_.x * axes_.y * axes_.z, volume = measures().volume;
  const double plane = 4.0 / 3.0 * factorial(3.0 * a) * factorial(a) / factorial(4.0 * a);
  const double across = product * plane * 2.0 * factorial(b) * factorial(4.0 * b) / factorial(5.0 * b);
  const double disc = 4.0 * factorial(a) * factorial(a) / factorial(2.0 * a);
  const double along = product * disc * 2.0 / 3.0 * factorial(3.0 * b) * factorial(2.0 * b) / factorial(5.0 * b);
  return SolidMoments::diagonal(volume, {},
                                {across * axes_.x * axes_.x, across * axes_.y * axes_.y, along * axes_.z * axes_.z});
}

}  // namespace vex

// How the relative orientation R of B in A's frame is distributed: an inversion map from the unit cube, without
// rejection, for each law.
//
// Without rejection every trial uses the same coordinates for the same purpose, so random and quasi-random points share
// the map. No C library function and no fused operation: a rotation is the same bits everywhere (elementary.h).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "engine/numeric/elementary.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/transform.h"

namespace vex {

/// The matrices drawn by any law are rotations to within this (E6).
inline constexpr double kDrawnRotationError = 0x1p-46;

/// The rows of a uniformly distributed rotation (K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992):
/// sine and cosine of two uniform angles, and how the unit quaternion is shared between them.
template <class L>
Transform<L> uniform_rotation(const L& u, const SinCos<L>& first, const SinCos<L>& second) {
  const L short_leg = square_root(L(1.0) - u);
  const L long_leg = square_root(u);
  const L qx = short_leg * first.sin, qy = short_leg * first.cos;
  const L qz = long_leg * second.sin, qw = long_leg * second.cos;
  const L one = L(1.0), two = L(2.0);
  return {{one - two * (qy * qy + qz * qz), two * (qx * qy - qw * qz), two * (qx * qz + qw * qy)},
          {two * (qx * qy + qw * qz), one - two * (qx * qx + qz * qz), two * (qy * qz - qw * qx)},
          {two * (qx * qz - qw * qy), two * (qy * qz + qw * qx), one - two * (qx * qx + qy * qy)},
          {}};
}
template <class L>
Transform<L> uniform_rotation(const L& u, const L& v, const L& w) {
  return uniform_rotation(u, sincospi(v + v), sincospi(w + w));
}

/// Rz(phi) Ry(theta) Rz(psi): z goes to the polar angle theta and the azimuth phi = 2 pi v, psi = 2 pi w.
template <class L>
Transform<L> rotation_of_axis(const L& sin_theta, const L& cos_theta, const L& v, const L& w) {
  const SinCos<L> phi = sincospi(v + v), psi = sincospi(w + w);
  const Vec3<L> x{cos_theta * psi.cos, -(cos_theta * psi.sin), sin_theta}, y{psi.sin, psi.cos, L(0.0)};
  const Vec3<L> z{-(sin_theta * psi.cos), sin_theta * psi.sin, cos_theta};
  return {phi.cos * x - phi.sin * y, phi.sin * x + phi.cos * y, z, {}};
}

/// A value: cheap to copy, never changes.
class OrientationLaw {
 public:
  enum class Kind {
    isotropic,  // uniform over all rotations
    aligned,    // R = I
    fixed,      // one R
    cone,       // both z axes within an angle of +-z
    angle,      // B's z axis at one angle to A's
    onsager,    // both z axes by Onsager's trial function
  };

  OrientationLaw() = default;  // isotropic
  static OrientationLaw isotropic() { return {}; }
  static OrientationLaw aligned();
  /// B's quaternion in A's frame, of any length but 0 (rotation_from_quaternion).
  static OrientationLaw fixed(double w, double x, double y, double z);
  /// Each body's z axis independently, about a common axis: cos(theta) uniform on [cos(degrees), 1] times a random
  /// sign, all other angles uniform (Balberg, Anderson, Alexander, Wagner, Phys. Rev. B 30, 3933, 1984). 0 <= degrees
  /// <= 90.
  static OrientationLaw cone(double degrees);
  /// B's z axis at this angle to A's, each body spun uniformly about its own. 0 <= degrees <= 180.
  static OrientationLaw angle(double degrees);
  /// Each body's z axis independently with a density proportional to cosh(alpha cos(theta)) in solid angle (L. Onsager,
  /// Ann. N.Y. Acad. Sci. 51, 627, 1949), all other angles uniform. alpha >= 0; 0 is isotropic.
  static OrientationLaw onsager(double alpha);

  Kind kind() const { return kind_; }
  /// The angle in degrees of cone and angle, alpha of onsager, 0 of all others.
  double parameter() const { return parameter_; }
  /// isotropic, aligned, fixed:1,0,0,0, cone:30, angle:30, onsager:5.
  std::string name() const;

  /// The mean of P_2(cos theta) = (3 cos^2 theta - 1) / 2 of each body's z axis about the common one: 0 of isotropic, 1
  /// where all are parallel. Nothing for `fixed` and `angle`, which have no common axis.
  std::optional<double> order_parameter() const;

  friend bool operator==(const OrientationLaw& x, const OrientationLaw& y) {
    return x.kind_ == y.kind_ && x.parameter_ == y.parameter_ && x.quaternion_ == y.quaternion_;
  }

  static constexpr int kMaxDimension = 5;
  /// How many coordinates of the unit cube `rotation` uses; 0 where there is but one orientation.
  int dimension() const;

  /// R for a point of the open unit cube (at least `dimension()` coordinates); no translation.
  template <class L>
  Transform<L> rotation(std::span<const L> point) const;

  /// One body's own rotation in the frame of the common axis, for a point of the open unit cube of three coordinates:
  /// of two bodies R_A^T R_B is distributed as `rotation` is. Not of `fixed` and `angle`, which are about two bodies.
  template <class L>
  Transform<L> rotation_of_body(std::span<const L> point) const;

 private:
  template <class L>
  struct Polar {
    L sin, cos;
  };
  template <class L>
  Polar<L> polar_angle(const L& u) const;

  Kind kind_ = Kind::isotropic;
  Transformd fixed_{};  // of fixed
  std::array<double, 4> quaternion_{1.0, 0.0, 0.0, 0.0};
  double parameter_ = 0.0;  // degrees, or alpha
  Polar<double> between_{0.0, 1.0};  // of angle
  double height_ = 0.0;     // of cone: 1 - cos(degrees); of onsager: 1 - exp(-2 alpha)
};

/// sin and cos of one body's polar angle. The coordinate's upper bit is the sign of cos, the rest is spread over
/// d = 1 - |cos| (cone), or over 1 - cos of the density exp(alpha cos), of which with both signs cosh is made
/// (onsager).
template <class L>
OrientationLaw::Polar<L> OrientationLaw::polar_angle(const L& u) const {
  const L one = L(1.0), two = L(2.0), twice = u + u;
  const MaskOf<L> up = twice > one;
  const L v = select(up, twice - one, twice);  // exact, and never 0 or 1: u is an odd multiple of 2^-53
  L d;
  if (kind_ == Kind::cone) {
    d = L(height_) * v;
  } else if (parameter_ < 0x1p-60) {
    d = v + v;  // exp(alpha cos) is 1 to rounding
  } else {
    d = minus_log_of_complement(L(height_) * v) / L(parameter_);
  }
  d = select(d > two, two, d);  // which only rounding can exceed
  const L cos = one - d;
  return {square_root(d * (two - d)), select(up, cos, -cos)};
}

/// Of cone and onsager: with R_X = Rz(phi) Ry(theta) Rz(psi) for each body, R = R_A^T R_B depends on the difference of
/// the two phi alone, which is uniform.
template <class L>
Transform<L> OrientationLaw::rotation(std::span<const L> point) const {
  switch (kind_) {
    case Kind::isotropic: return uniform_rotation(point[0], point[1], point[2]);
    case Kind::aligned: return {};
    case Kind::fixed: return {broadcast<L>(fixed_.row_x), broadcast<L>(fixed_.row_y), broadcast<L>(fixed_.row_z), {}};
    case Kind::angle: return rotation_of_axis(L(between_.sin), L(between_.cos), point[0], point[1]);
    case Kind::cone:
    case Kind::onsager: break;
  }
  const Polar<L> a = polar_angle(point[0]), b = polar_angle(point[1]);
  const SinCos<L> phi = sincospi(point[2] + point[2]);
  const SinCos<L> psi_a = sincospi(point[3] + point[3]), psi_b = sincospi(point[4] + point[4]);
  // X = Ry(-theta_A) Rz(phi) Ry(theta_B)
  const Vec3<L> x{(a.cos * phi.cos) * b.cos + a.sin * b.sin, -(a.cos * phi.sin),
                  (a.cos * phi.cos) * b.sin - a.sin * b.cos};
  const Vec3<L> y{phi.sin * b.cos, phi.cos, phi.sin * b.sin};
  const Vec3<L> z{(a.sin * phi.cos) * b.cos - a.cos * b.sin, -(a.sin * phi.sin),
                  (a.sin * phi.cos) * b.sin + a.cos * b.cos};
  const auto turned = [&psi_b](const Vec3<L>& row) -> Vec3<L> {  // row Rz(psi_B)
    return {psi_b.cos * row.x + psi_b.sin * row.y, psi_b.cos * row.y - psi_b.sin * row.x, row.z};
  };
  return {turned(psi_a.cos * x + psi_a.sin * y), turned(psi_a.cos * y - psi_a.sin * x), turned(z), {}};
}

/// Of cone and onsager Rz(phi) Ry(theta) Rz(psi).
template <class L>
Transform<L> OrientationLaw::rotation_of_body(std::span<const L> point) const {
  VEX_EXPECT(kind_ != Kind::fixed && kind_ != Kind::angle);
  if (kind_ == Kind::isotropic) return uniform_rotation(point[0], point[1], point[2]);
  if (kind_ == Kind::aligned) return {};
  const Polar<L> theta = polar_angle(point[0]);
  return rotation_of_axis(theta.sin, theta.cos, point[1], point[2]);
}

}  // namespace vex

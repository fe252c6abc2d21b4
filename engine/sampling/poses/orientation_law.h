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
#include <utility>

#include "engine/numeric/elementary.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/poses/axis_law.h"

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
    isotropic,    // uniform over all rotations
    aligned,      // R = I
    fixed,        // one R
    angle,        // B's axis at one angle to A's
    cone,         // both axes within an angle of the common one
    onsager,      // both axes by Onsager's trial function
    maier_saupe,  // both axes by Maier and Saupe's law
    table,        // both axes by a density given by points
    each,         // the two axes by laws that differ
  };

  OrientationLaw() = default;  // isotropic
  static OrientationLaw isotropic() { return {}; }
  static OrientationLaw aligned();
  /// B's quaternion in A's frame, of any length but 0 (rotation_from_quaternion).
  static OrientationLaw fixed(double w, double x, double y, double z);
  /// B's axis at this angle to A's, each body spun uniformly about its own. 0 <= degrees <= 180.
  static OrientationLaw angle(double degrees);
  /// Each body's axis independently, about a common axis, all other angles uniform: as AxisLaw has them. A cone's is
  /// the law of Balberg, Anderson, Alexander, Wagner, Phys. Rev. B 30, 3933, 1984.
  static OrientationLaw cone(double degrees) { return both_by(AxisLaw::cone(degrees)); }
  static OrientationLaw onsager(double alpha) { return both_by(AxisLaw::onsager(alpha)); }
  static OrientationLaw maier_saupe(double strength) { return both_by(AxisLaw::maier_saupe(strength)); }
  static OrientationLaw table(AxisTable table) { return both_by(AxisLaw::table(std::move(table))); }
  /// A body's axis by a law of its own. Where one of them is isotropic the relative orientation is too, and where both
  /// are aligned it is `aligned`; a body that is aligned beside one that is not is spun about the common axis.
  static OrientationLaw each(const AxisLaw& a, const AxisLaw& b);
  static OrientationLaw both_by(const AxisLaw& law) { return each(law, law); }

  /// The same law for bodies whose own axes are these directions, of any length but 0, and not z. UsageError where
  /// nothing hangs on an axis: isotropic, aligned, fixed.
  OrientationLaw about(const Vec3d& axis_a, const Vec3d& axis_b) const;

  Kind kind() const { return kind_; }
  /// The law of body 0 or 1: of isotropic, aligned, and all from cone on.
  const AxisLaw& of_body(std::size_t body) const { return axis_[body]; }
  /// The angle in degrees of cone and angle, alpha of onsager, A of maier_saupe, 0 of all others.
  double parameter() const {
    return kind_ == Kind::angle ? degrees_ : (kind_ == Kind::each ? 0.0 : axis_[0].parameter());
  }
  /// isotropic, aligned, fixed:1,0,0,0, angle:30, AxisLaw's names, and "A cone:30, B onsager:5" where they differ; with
  /// " about 1,0,0" behind where an axis is not z, of A and of B. Laws of one name draw alike.
  std::string name() const;

  /// The mean of P_2(cos theta) = (3 cos^2 theta - 1) / 2 of each body's axis about the common one: 0 of isotropic, 1
  /// where all are parallel. Nothing for `fixed` and `angle`, which have no common axis, and where the bodies differ.
  std::optional<double> order_parameter() const;
  /// The same of A and of B, which may differ. Nothing for `fixed` and `angle`.
  std::optional<std::array<double, 2>> order_parameters() const;

  /// Whether each body is spun uniformly about its z axis: of all but aligned and fixed, and those about other axes.
  bool spins_about_z() const { return kind_ != Kind::aligned && kind_ != Kind::fixed && !has_axes_; }
  /// Whether both axes are always parallel or antiparallel, with any spin.
  bool keeps_axes_parallel() const { return kind_ >= Kind::cone && axis_[0].is_along() && axis_[1].is_along(); }
  /// Whether the axes are others than z, and which direction of its own body 0 or 1 has on the axis.
  bool has_axes() const { return has_axes_; }
  const Vec3d& axis_of(std::size_t body) const { return z_from_body_[body].row_z; }

  friend bool operator==(const OrientationLaw& x, const OrientationLaw& y);

  static constexpr int kMaxDimension = 5;
  /// How many coordinates of the unit cube `rotation` uses; 0 where there is but one orientation.
  int dimension() const;

  /// R for a point of the open unit cube (at least `dimension()` coordinates); no translation.
  template <class L>
  Transform<L> rotation(std::span<const L> point) const;

  /// One body's own rotation in the frame of the common axis, for a point of the open unit cube of three coordinates:
  /// of two bodies R_A^T R_B is distributed as `rotation` is. Not of `fixed`, `angle` and `each`, which are about two
  /// bodies.
  template <class L>
  Transform<L> rotation_of_body(std::span<const L> point) const;

 private:
  template <class L>
  Transform<L> between_axes(std::span<const L> point) const;

  Kind kind_ = Kind::isotropic;
  bool has_axes_ = false;
  Transformd fixed_{};  // of fixed
  std::array<double, 4> quaternion_{1.0, 0.0, 0.0, 0.0};
  double degrees_ = 0.0;                     // of angle
  SinCos<double> between_{0.0, 1.0};         // of angle
  std::array<AxisLaw, 2> axis_{};            // isotropic, aligned, and all from cone on
  std::array<Transformd, 2> z_from_body_{};  // rotations that take the bodies' axes to z
};

/// Q_A^T R Q_B.
template <class L>
Transform<L> between_frames(const Transformd& a, const Transform<L>& r, const Transformd& b) {
  const Vec3<L> b_x = broadcast<L>(b.row_x), b_y = broadcast<L>(b.row_y), b_z = broadcast<L>(b.row_z);
  const Vec3<L> x = (r.row_x.x * b_x + r.row_x.y * b_y) + r.row_x.z * b_z;
  const Vec3<L> y = (r.row_y.x * b_x + r.row_y.y * b_y) + r.row_y.z * b_z;
  const Vec3<L> z = (r.row_z.x * b_x + r.row_z.y * b_y) + r.row_z.z * b_z;
  return {(L(a.row_x.x) * x + L(a.row_y.x) * y) + L(a.row_z.x) * z,
          (L(a.row_x.y) * x + L(a.row_y.y) * y) + L(a.row_z.y) * z,
          (L(a.row_x.z) * x + L(a.row_y.z) * y) + L(a.row_z.z) * z,
          {}};
}

template <class L>
Transform<L> OrientationLaw::rotation(std::span<const L> point) const {
  switch (kind_) {
    case Kind::isotropic: return uniform_rotation(point[0], point[1], point[2]);
    case Kind::aligned: return {};
    case Kind::fixed: return {broadcast<L>(fixed_.row_x), broadcast<L>(fixed_.row_y), broadcast<L>(fixed_.row_z), {}};
    default: break;
  }
  const Transform<L> of_axes = between_axes(point);
  return has_axes_ ? between_frames(z_from_body_[0], of_axes, z_from_body_[1]) : of_axes;
}

/// With R_X = Rz(phi) Ry(theta) Rz(psi) for each body, R = R_A^T R_B depends on the difference of the two phi alone,
/// which is uniform.
template <class L>
Transform<L> OrientationLaw::between_axes(std::span<const L> point) const {
  if (kind_ == Kind::angle) return rotation_of_axis(L(between_.sin), L(between_.cos), point[0], point[1]);
  const AxisLaw::Polar<L> a = axis_[0].polar_angle(point[0]), b = axis_[1].polar_angle(point[1]);
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

template <class L>
Transform<L> OrientationLaw::rotation_of_body(std::span<const L> point) const {
  VEX_EXPECT(kind_ != Kind::fixed && kind_ != Kind::angle && kind_ != Kind::each);
  if (kind_ == Kind::isotropic) return uniform_rotation(point[0], point[1], point[2]);
  if (kind_ == Kind::aligned) return {};
  const AxisLaw::Polar<L> theta = axis_[0].polar_angle(point[0]);
  const Transform<L> turned = rotation_of_axis(theta.sin, theta.cos, point[1], point[2]);
  return has_axes_ ? between_frames(Transformd{}, turned, z_from_body_[0]) : turned;
}

}  // namespace vex

// The map from the unit cube to the rays of the radial estimator.
//
// V_ex(R) is the volume of K = A - RB. About a point of K, and for any regular matrix L,
//   |K| = det L * integral over the unit sphere of r(L e)^3 / 3 = mean over uniform e of (4 pi / 3) det L r(L e)^3,
// r being the radial function: L^-1 K has the volume |K| / det L and the radial function r(L e). L may depend on R. The
// nearer L^-1 K is to a ball, the less is left to vary: L L^T = Q_A + R Q_B R^T, Q being the matrix of an ellipsoid
// like the body.
#pragma once

#include <array>
#include <numbers>
#include <span>

#include "engine/numeric/elementary.h"
#include "engine/numeric/transform.h"
#include "engine/query/radial_function.h"
#include "engine/query/radial_steps.h"
#include "engine/sampling/orientation_law.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A symmetric matrix. Units of length^2.
template <class L>
struct Symmetric {
  L xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0}, xz{0.0}, yz{0.0};
};

/// Lower triangular.
template <class L>
struct Triangular {
  L xx, yx, yy, zx, zy, zz;

  /// L v
  Vec3<L> operator()(const Vec3<L>& v) const {
    return {xx * v.x, yx * v.x + yy * v.y, (zx * v.x + zy * v.y) + zz * v.z};
  }
  /// L^-T v: across the image of the unit sphere where that is L v.
  Vec3<L> normal(const Vec3<L>& v) const {
    const L z = v.z / zz, y = (v.y - zy * z) / yy;
    return {((v.x - yx * y) - zx * z) / xx, y, z};
  }
  L determinant() const { return (xx * yy) * zz; }
};

/// Cholesky's factor. A pivot that rounding, or a flat body, leaves without a size is kept at 2^-50 of the trace, which
/// rounding does not reach.
template <class L>
Triangular<L> factor_of(const Symmetric<L>& q) {
  const L least = L(0x1p-50) * ((q.xx + q.yy) + q.zz);
  Triangular<L> f;
  f.xx = square_root(larger(q.xx, least));
  f.yx = q.xy / f.xx;
  f.zx = q.xz / f.xx;
  f.yy = square_root(larger(q.yy - f.yx * f.yx, least));
  f.zy = (q.yz - f.zx * f.yx) / f.yy;
  f.zz = square_root(larger((q.zz - f.zx * f.zx) - f.zy * f.zy, least));
  return f;
}

/// An ellipsoid like the body, of which nothing but its support points is asked: the directions that are uniform
/// normals of the ellipsoid have support points with the mean `centre`, a point of the body, and Q is 3 times the mean
/// of their squares (s - centre)(s - centre)^T. Of an ellipsoid not thinner than 2^-24 it is the ellipsoid, of a box
/// that of the half edges; what turns and stretches the body turns and stretches it. Found by a few rounds of the
/// equation.
struct MatchingEllipsoid {
  Vec3d centre;
  Symmetric<double> q;
};
MatchingEllipsoid matching_ellipsoid(const ConvexBody& body);

template <class L>
struct RadialRay {
  Transform<L> rotation;
  Vec3<L> dir;
  std::array<Vec3<L>, 3> normals;  // of the ellipsoid's, around where the ray leaves it
  L pick{0.0};
  L weight{0.0};  // times r(dir)^3: the volume whose mean is V_ex
};

/// What a pair's rays are made of.
class RadialMap {
 public:
  RadialMap(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law)
      : law_(law), a_(matching_ellipsoid(a)), b_(matching_ellipsoid(b)) {}

  /// Of each body the point that coincides with the other's where rays begin.
  BodyPoints points() const { return {a_.centre, b_.centre}; }

  static constexpr int kMaxDimension = 3 + OrientationLaw::kMaxDimension;
  /// Coordinates of the unit cube: two for e, those of the law, and the pick.
  int dimension() const { return 3 + law_.dimension(); }

  template <class L>
  RadialRay<L> operator()(std::span<const L> point) const {
    const std::size_t n_of_law = static_cast<std::size_t>(law_.dimension());
    const Frame<L> at = frame(point[0], point[1]);
    RadialRay<L> ray;
    ray.rotation = law_.kind() == OrientationLaw::Kind::isotropic
                       ? rotation_to(at, frame(point[2], point[3]), sincospi(point[4] + point[4]))
                       : law_.rotation(point.subspan(2, n_of_law));
    ray.pick = point[2 + n_of_law];
    const Triangular<L> l = factor_of(of_difference(ray.rotation));
    ray.dir = l(at.axis);
    ray.weight = L(4.0 / 3.0 * std::numbers::pi) * l.determinant();
    // Three normals at 120 degrees about e.
    const L out(kRadialSpread), half_out(0.5 * kRadialSpread), side(kRadialSpread * 0.5 * std::numbers::sqrt3);
    const Vec3<L> back = at.axis - half_out * at.across_1, beside = side * at.across_2;
    ray.normals = {l.normal(at.axis + out * at.across_1), l.normal(back + beside), l.normal(back - beside)};
    return ray;
  }

 private:
  // Right-handed: across_1, across_2, axis.
  template <class L>
  struct Frame {
    Vec3<L> across_1, across_2, axis;
  };
  /// The axis uniform on the sphere.
  template <class L>
  static Frame<L> frame(const L& u, const L& v) {
    const SinCos<L> azimuth = sincospi(v + v);
    const L cos_polar = L(1.0) - (u + u), sin_polar = L(2.0) * square_root(u * (L(1.0) - u));
    return {{cos_polar * azimuth.cos, cos_polar * azimuth.sin, -sin_polar},
            {-azimuth.sin, azimuth.cos, L(0.0)},
            {sin_polar * azimuth.cos, sin_polar * azimuth.sin, cos_polar}};
  }

  // The rotation that takes B's axis to A's, with a turn about it. Uniform over all rotations, whatever A's is, if B's
  // axis and the turn are. So one pair of coordinates is where the ray is as A sees it, another as B does, on whose
  // directions r depends more than on the turn: quasi-random points are best where few coordinates matter together.
  template <class L>
  static Transform<L> rotation_to(const Frame<L>& a, const Frame<L>& b, const SinCos<L>& turn) {
    const Vec3<L> first = turn.cos * a.across_1 + turn.sin * a.across_2;
    const Vec3<L> second = turn.cos * a.across_2 - turn.sin * a.across_1;
    const auto row = [&b](const L& x, const L& y, const L& z) {
      return (x * b.across_1 + y * b.across_2) + z * b.axis;
    };
    return {row(first.x, second.x, a.axis.x), row(first.y, second.y, a.axis.y), row(first.z, second.z, a.axis.z), {}};
  }

  /// Q_A + R Q_B R^T
  template <class L>
  Symmetric<L> of_difference(const Transform<L>& r) const {
    const Symmetric<double>&q_a = a_.q, &q_b = b_.q;
    const auto times_q_b = [&q_b](const Vec3<L>& v) -> Vec3<L> {
      return {(L(q_b.xx) * v.x + L(q_b.xy) * v.y) + L(q_b.xz) * v.z,
              (L(q_b.xy) * v.x + L(q_b.yy) * v.y) + L(q_b.yz) * v.z,
              (L(q_b.xz) * v.x + L(q_b.yz) * v.y) + L(q_b.zz) * v.z};
    };
    const Vec3<L> x = times_q_b(r.row_x), y = times_q_b(r.row_y), z = times_q_b(r.row_z);
    return {L(q_a.xx) + dot(r.row_x, x), L(q_a.yy) + dot(r.row_y, y), L(q_a.zz) + dot(r.row_z, z),
            L(q_a.xy) + dot(r.row_x, y), L(q_a.xz) + dot(r.row_x, z), L(q_a.yz) + dot(r.row_y, z)};
  }

  OrientationLaw law_;
  MatchingEllipsoid a_, b_;
};

}  // namespace vex

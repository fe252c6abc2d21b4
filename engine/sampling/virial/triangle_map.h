// The map from the unit cube to triangles: three like bodies, from which B3 is had without a hit or a miss.
//
// At given orientations the places (x, w) of the second and the third body, seen from the first, at which all three
// overlap are a convex body C of six dimensions: x is in K12, w in K13 and w - x in K23, the differences of the pairs.
// It holds the origin, so for any regular matrix T
//   |C| = mean over uniform unit vectors z of (pi^3 / 6) det T lambda^6,
// lambda z being as far as T^-1 C reaches: (x, w) = T z, and lambda is the least of the radial functions of the three
// differences along x, w and w - x. With <V_ex> = 2 B2, B3 / B2^2 = (4/3) <|C|> / <V_ex>^2.
//
// T may depend on the orientations, and the nearer T^-1 C is to a ball, the less is left to vary. Q being the matrix of
// an ellipsoid like the body, turned with it, K_ij is nearly the image of a ball under D_ij, the root of Q_i + Q_j, and
// with G = (D13 + D23)^-1
//   x = 2 / sqrt(3) D12 z',   w = D13 G (x + 2 D23 z''),   z = (z', z''):
// the third body is drawn about the middle of the first two, as its two neighbours' shapes have it. Of like balls this
// is the ellipsoid that has the triangle's symmetry.
//
// Only how the bodies are turned against the triangle matters. So z' is along the world's z, z'' in the plane of x and
// z, and each body is turned uniformly; all of T turns with the bodies. Of balls two coordinates are left to matter, of
// bodies of revolution eight, and a net's first coordinates are those.
#pragma once

#include <array>
#include <numbers>
#include <span>

#include "engine/numeric/elementary.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/radial/frames.h"
#include "engine/sampling/radial/radial_body.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/sampling/radial/radial_steps.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Two of the three bodies in the frame of the first of them, as a ray of their difference.
template <class L>
struct TriangleSide {
  Transform<L> rotation;
  Vec3<L> dir;                     // between the bodies' points, without a unit
  std::array<Vec3<L>, 3> normals;  // around where the ray leaves the difference
};

template <class L>
struct Triangle {
  std::array<TriangleSide<L>, 3> sides;
  L weight, pick;
};

class TriangleMap {
 public:
  /// `law` is isotropic or aligned.
  TriangleMap(const ConvexBody& body, const OrientationLaw& law);

  static constexpr int kMaxDimension = 12;
  /// Two of the triangle's shape; two and a turn of each body, or of all; the pick.
  int dimension() const { return is_isotropic_ ? kMaxDimension : 6; }
  /// Of each pair of bodies, where rays begin.
  BodyPoints points() const { return {body_.centre, body_.centre}; }
  /// Whether the body is not longer than 2^7 of what it is across; where all are turned alike, of what it is anywhere.
  /// Flat bodies cross each other, and their difference is not flat.
  bool is_usable() const;

  template <class L>
  Triangle<L> operator()(std::span<const L> point) const {
    Triangle<L> triangle;
    triangle.pick = point[static_cast<std::size_t>(dimension() - 1)];
    const std::size_t n_turned = is_isotropic_ ? 3 : 1;
    std::array<Frame<L>, 3> own;  // the bodies' own axes as the world sees them
    std::array<Symmetric<L>, 3> q;
    for (std::size_t k = 0; k < 3; ++k) {
      own[k] = k < n_turned ? axes_of(point[2 + 2 * k], point[3 + 2 * k], point[2 + 2 * n_turned + k], triangle.pick)
                            : own[0];
      q[k] = k < n_turned ? in_world(own[k]) : q[0];
    }
    const Inverse<L> d_12(root(sum(q[0], q[1]))), d_13(root(sum(q[0], q[2]))), d_23(root(sum(q[1], q[2])));
    const Inverse<L> both_of_third(sum(d_13.of, d_23.of));

    // |z'|^2 has the density (8 / pi) sqrt(t (1 - t)).
    const L one(1.0), t = point[0], polar = point[1], spread = square_root(t * (one - t));
    const L first = square_root(t), second = square_root(one - t);
    const L sine = L(2.0) * square_root(polar * (one - polar)), cosine = one - (polar + polar);
    const Vec3<L> x = (L(2.0 / std::numbers::sqrt3) * first) * Vec3<L>{d_12.of.xz, d_12.of.yz, d_12.of.zz};
    const Vec3<L> aside = times(d_23.of, Vec3<L>{second * sine, L(0.0), second * cosine});
    const Vec3<L> w = times(d_13.of, times(both_of_third.inverse, x + L(2.0) * aside));

    // 4/3 (8 / pi) (pi^3 / 6) det T, with (4/3)^(3/2) = 8 / (3 sqrt(3)) and 2^3 from T.
    constexpr double kFactor = 4.0 / 3.0 * 8.0 / std::numbers::pi *
                               (std::numbers::pi * std::numbers::pi * std::numbers::pi / 6.0) *
                               (8.0 / (3.0 * std::numbers::sqrt3)) * 8.0;
    triangle.weight = ((L(kFactor) * spread) * d_12.determinant) *
                      ((d_13.determinant * d_23.determinant) / both_of_third.determinant);
    triangle.sides = {side(own[0], own[1], d_12, x), side(own[0], own[2], d_13, w), side(own[1], own[2], d_23, w - x)};
    return triangle;
  }

 private:
  template <class L>
  static Symmetric<L> sum(const Symmetric<L>& a, const Symmetric<L>& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
  }
  template <class L>
  static Vec3<L> times(const Symmetric<L>& m, const Vec3<L>& v) {
    return {(m.xx * v.x + m.xy * v.y) + m.xz * v.z, (m.xy * v.x + m.yy * v.y) + m.yz * v.z,
            (m.xz * v.x + m.yz * v.y) + m.zz * v.z};
  }
  // A symmetric matrix like the root of Q: by the theorem of Cayley and Hamilton, from its own invariants (A. Hoger and
  // D. E. Carlson, Q. Appl. Math. 42, 113, 1984). Its trace is the largest root of a quartic, to which Newton's steps
  // come down; where they end too early the matrix is another one, but it still turns with Q.
  template <class L>
  static Symmetric<L> root(const Symmetric<L>& q) {
    const L two(2.0), four(4.0), one = (q.xx + q.yy) + q.zz;
    const L xx = q.yy * q.zz - q.yz * q.yz, yy = q.xx * q.zz - q.xz * q.xz, zz = q.xx * q.yy - q.xy * q.xy;
    const L second = (xx + yy) + zz;
    const L det = (q.xx * xx + q.xy * (q.xz * q.yz - q.xy * q.zz)) + q.xz * (q.xy * q.yz - q.xz * q.yy);
    const L third = square_root(larger(det, L(0x1p-50) * ((one * one) * one)));
    L trace = square_root(L(3.0) * one);
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
      const L square = trace * trace, cubic = trace * (square - one);
      const L value =
          (square * square - two * (one * square)) - (L(8.0) * (third * trace) - (one * one - four * second));
      trace = trace - value / (four * cubic - L(8.0) * third);
    }
    const L middle = L(0.5) * (trace * trace - one), scale = L(1.0) / (trace * middle - third);
    const L of_one = scale * (trace * third), of_q = scale * (trace * trace - middle);
    const Vec3<L> x{q.xx, q.xy, q.xz}, y{q.xy, q.yy, q.yz}, z{q.xz, q.yz, q.zz};
    return {(of_one + of_q * q.xx) - scale * dot(x, x),
            (of_one + of_q * q.yy) - scale * dot(y, y),
            (of_one + of_q * q.zz) - scale * dot(z, z),
            of_q * q.xy - scale * dot(x, y),
            of_q * q.xz - scale * dot(x, z),
            of_q * q.yz - scale * dot(y, z)};
  }
  template <class L>
  struct Inverse {
    explicit Inverse(const Symmetric<L>& m) : of(m) {
      const L xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz, xz = m.xy * m.yz - m.xz * m.yy;
      determinant = (m.xx * xx + m.xy * xy) + m.xz * xz;
      const L scale = L(1.0) / determinant;
      inverse = {scale * xx, scale * (m.xx * m.zz - m.xz * m.xz), scale * (m.xx * m.yy - m.xy * m.xy), scale * xy,
                 scale * xz, scale * (m.xy * m.xz - m.xx * m.yz)};
    }
    Symmetric<L> of, inverse;
    L determinant;
  };

  // Uniform, but that of a body that looks the same after half a turn about its x the pick tells on which side z is.
  template <class L>
  Frame<L> axes_of(const L& u, const L& v, const L& turn, L& pick) const {
    const L about_z = in_some_sector(body_.turns.n_sectors, turn, pick);
    if (body_.turns.poles == Turns::Poles::one) return turned(frame(u, v), sincospi(about_z + about_z));
    Frame<L> f = turned(frame(L(0.5) * u, v), sincospi(about_z + about_z));
    const L sign = sign_by(pick);
    f.across_2 = sign * f.across_2;
    f.axis = sign * f.axis;
    return f;
  }
  template <class L>
  Symmetric<L> in_world(const Frame<L>& own) const {
    const Vec3<L>&x = own.across_1, &y = own.across_2, &z = own.axis;
    const Vec3<L> a = L(squares_.x) * x, b = L(squares_.y) * y, c = L(squares_.z) * z;
    return {(a.x * x.x + b.x * y.x) + c.x * z.x, (a.y * x.y + b.y * y.y) + c.y * z.y,
            (a.z * x.z + b.z * y.z) + c.z * z.z, (a.x * x.y + b.x * y.y) + c.x * z.y,
            (a.x * x.z + b.x * y.z) + c.x * z.z, (a.y * x.z + b.y * y.z) + c.y * z.z};
  }
  template <class L>
  static Vec3<L> in_own_axes(const Frame<L>& own, const Vec3<L>& v) {
    return {dot(own.across_1, v), dot(own.across_2, v), dot(own.axis, v)};
  }
  template <class L>
  Vec3<L> in_body(const Vec3<L>& own) const {
    if (body_.is_upright) return own;
    return (own.x * broadcast<L>(body_.axes.row_x) + own.y * broadcast<L>(body_.axes.row_y)) +
           own.z * broadcast<L>(body_.axes.row_z);
  }

  template <class L>
  TriangleSide<L> side(const Frame<L>& a, const Frame<L>& b, const Inverse<L>& d, const Vec3<L>& dir) const {
    TriangleSide<L> found;
    found.rotation = rotation(a, b);
    found.dir = in_body(in_own_axes(a, dir));
    const Frame<L> at = frame_about(scaled_to_unit(times(d.inverse, dir)));
    const auto normal = [&](const Vec3<L>& v) { return in_body(in_own_axes(a, times(d.inverse, v))); };
    const Vec3<L> along = normal(at.axis), across_1 = normal(at.across_1), across_2 = normal(at.across_2);
    // As RadialNumbers has them, and for the same reason.
    const auto leaning = [&](double to_1, double to_2) {
      return (along + L(kRadialSpread * to_1) * across_1) + L(kRadialSpread * to_2) * across_2;
    };
    found.normals = {leaning(1.07, 0.16), leaning(-0.60, 0.83), leaning(-0.43, -0.94)};
    return found;
  }
  template <class L>
  Transform<L> rotation(const Frame<L>& a, const Frame<L>& b) const {
    const L zero(0.0), one(1.0);
    if (!is_isotropic_) return {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}, {}};
    // Rows in B's own axes, by A's own axes; then both as the body's frame has them.
    const auto row = [&](const Vec3<L>& axis_of_a) { return in_body(in_own_axes(b, axis_of_a)); };
    const Vec3<L> x = row(a.across_1), y = row(a.across_2), z = row(a.axis);
    if (body_.is_upright) return {x, y, z, {}};
    const Vec3d &of_x = body_.axes.row_x, &of_y = body_.axes.row_y, &of_z = body_.axes.row_z;
    const auto in_frame = [&](double along_x, double along_y, double along_z) {
      return (L(along_x) * x + L(along_y) * y) + L(along_z) * z;
    };
    return {in_frame(of_x.x, of_y.x, of_z.x), in_frame(of_x.y, of_y.y, of_z.y), in_frame(of_x.z, of_y.z, of_z.z), {}};
  }

  bool is_isotropic_;
  RadialBody body_;
  Vec3d squares_;  // Q in the body's own axes, where it is as good as diagonal, in units of the circumradius
};

}  // namespace vex

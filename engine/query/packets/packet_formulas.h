// Pairs whose overlap has a formula, a packet of poses at a time and proven (E33): two boxes by separating axes, two
// segments with balls about them by their nearest points, two ellipsoids by the direction between their nearest level
// sets. What a formula leaves open is left to the search.
#pragma once

#include <cstddef>

#include "engine/query/packets/packet_difference.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

template <int W>
struct FormulaAnswer {
  PacketMask<W> disjoint, overlap;
};

/// From A's centre to B's, as placed.
template <class L>
Vec3<L> between_centres(const PairFormula& pair, const Transform<L>& pose) {
  return pose(broadcast<L>(pair.centre_b)) - broadcast<L>(pair.centre_a);
}

class BoxesFormula {
 public:
  /// error: PacketDifference::error.
  BoxesFormula(const PairFormula& pair, double error) : pair_(pair), error_(error) {}

  template <int W>
  FormulaAnswer<W> operator()(const Transform<Packet<W>>& pose) const {
    using L = Packet<W>;
    const Vec3<L> between = between_centres(pair_, pose);
    const L t[3] = {between.x, between.y, between.z};
    const L h[3] = {L(pair_.half_a.x), L(pair_.half_a.y), L(pair_.half_a.z)};
    const L g[3] = {L(pair_.half_b.x), L(pair_.half_b.y), L(pair_.half_b.z)};
    const L c[3][3] = {{pose.row_x.x, pose.row_y.x, pose.row_z.x},
                       {pose.row_x.y, pose.row_y.y, pose.row_z.y},
                       {pose.row_x.z, pose.row_y.z, pose.row_z.z}};  // B's axes
    L size_c[3][3], n[3][3], size_n[3][3];                           // and the normals of its faces
    for (std::size_t j = 0; j < 3; ++j) {
      const L(&p)[3] = c[kNext[j]], (&q)[3] = c[kNext[kNext[j]]];
      for (std::size_t i = 0; i < 3; ++i) {
        n[j][i] = p[kNext[i]] * q[kNext[kNext[i]]] - p[kNext[kNext[i]]] * q[kNext[i]];
        size_n[j][i] = absolute(n[j][i]);
        size_c[j][i] = absolute(c[j][i]);
      }
    }
    // The largest of the gaps along all axes, less what rounding may have added to each, or with it.
    L least(-__builtin_huge_val()), most(-__builtin_huge_val());
    const auto see = [&](const L& gap, const L& size) {
      const L slack = L(error_) * size;
      least = larger(least, gap - slack);
      most = larger(most, gap + slack);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const L of_b = g[0] * size_c[0][i] + (g[1] * size_c[1][i] + g[2] * size_c[2][i]);
      see((absolute(t[i]) - h[i]) - of_b, L(1.0));
    }
    const L volume = absolute(n[0][0] * c[0][0] + (n[0][1] * c[0][1] + n[0][2] * c[0][2]));
    for (std::size_t j = 0; j < 3; ++j) {
      const L way = absolute(n[j][0] * t[0] + (n[j][1] * t[1] + n[j][2] * t[2]));
      const L of_a = h[0] * size_n[j][0] + (h[1] * size_n[j][1] + h[2] * size_n[j][2]);
      see((way - of_a) - g[j] * volume, size_n[j][0] + (size_n[j][1] + size_n[j][2]));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t p = kNext[i], q = kNext[p];
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t k = kNext[j], l = kNext[k];
        const L way = absolute(t[p] * c[j][q] - t[q] * c[j][p]);
        const L of_a = h[p] * size_c[j][q] + h[q] * size_c[j][p];
        const L of_b = g[k] * size_n[l][i] + g[l] * size_n[k][i];
        see((way - of_a) - of_b, size_c[j][p] + size_c[j][q]);
      }
    }
    return {least > L(kNothing), most < L(kNothing)};
  }

 private:
  static constexpr std::size_t kNext[3] = {1, 2, 0};
  // More than the gap along an axis so short that its products may underflow, and less than the slack of any other.
  static constexpr double kNothing = 0x1p-600;

  PairFormula pair_;
  double error_;
};

class SegmentsFormula {
 public:
  SegmentsFormula(const PairFormula& pair, double ball_radius, double error)
      : pair_(pair), radius_(ball_radius), error_(error) {}

  template <int W>
  FormulaAnswer<W> operator()(const Transform<Packet<W>>& pose) const {
    using L = Packet<W>;
    const Vec3<L> between = between_centres(pair_, pose), u = broadcast<L>(pair_.half_a);
    const Vec3<L> half_b = broadcast<L>(pair_.half_b);
    const Vec3<L> v{dot(pose.row_x, half_b), dot(pose.row_y, half_b), dot(pose.row_z, half_b)};
    const auto within = [](const L& x) { return larger(smaller(x, L(1.0)), L(-1.0)); };
    // In units of the halves: of the lines' nearest points the one on A, brought into A; B's nearest point to that; and
    // A's to that. Any points would prove what they prove.
    const L uv = dot(u, v), of_a = L(pair_.inverse_a) * dot(u, between), of_b = L(pair_.inverse_b) * dot(v, between);
    const L u_of_v = L(pair_.inverse_a) * uv, v_of_u = L(pair_.inverse_b) * uv;
    const L across = larger(L(1.0) - u_of_v * v_of_u, L(0x1p-40));
    const L first = within((of_a - u_of_v * of_b) / across);
    const L on_b = within(v_of_u * first - of_b);
    const L on_a = within(u_of_v * on_b + of_a);
    const Vec3<L> way = (between + on_b * v) - on_a * u;
    const L length = norm(way);
    const L gap = ((dot(way, between) - absolute(dot(way, u))) - absolute(dot(way, v))) - L(radius_) * length;
    return {gap > L(error_) * norm_1(way), length < L(radius_ - error_)};
  }

 private:
  PairFormula pair_;
  double radius_, error_;
};

class EllipsoidsFormula {
 public:
  EllipsoidsFormula(const PairFormula& pair, double error) : pair_(pair), error_(pair.unit * error) {}

  template <int W>
  FormulaAnswer<W> operator()(const Transform<Packet<W>>& pose) const {
    using L = Packet<W>;
    const Vec3<L> t = L(pair_.unit) * pose.translation;
    // D R^T, by B's axes in A's frame; their squares' sum is B's matrix.
    const auto axis = [&](const L& x, const L& y, const L& z, double length) { return L(length) * Vec3<L>{x, y, z}; };
    const Vec3<L> p = axis(pose.row_x.x, pose.row_y.x, pose.row_z.x, pair_.axes_b.x);
    const Vec3<L> q = axis(pose.row_x.y, pose.row_y.y, pose.row_z.y, pair_.axes_b.y);
    const Vec3<L> r = axis(pose.row_x.z, pose.row_y.z, pose.row_z.z, pair_.axes_b.z);
    const L of_a(pair_.share_a), of_b(pair_.share_b);
    const L xx = of_b * (p.x * p.x + (q.x * q.x + r.x * r.x)) + of_a * L(pair_.squares_a.x);
    const L yy = of_b * (p.y * p.y + (q.y * q.y + r.y * r.y)) + of_a * L(pair_.squares_a.y);
    const L zz = of_b * (p.z * p.z + (q.z * q.z + r.z * r.z)) + of_a * L(pair_.squares_a.z);
    const L xy = of_b * (p.x * p.y + (q.x * q.y + r.x * r.y));
    const L xz = of_b * (p.x * p.z + (q.x * q.z + r.x * r.z));
    const L yz = of_b * (p.y * p.z + (q.y * q.z + r.y * r.z));
    const L c_xx = yy * zz - yz * yz, c_yy = xx * zz - xz * xz, c_zz = xx * yy - xy * xy;
    const L c_xy = xz * yz - xy * zz, c_xz = xy * yz - xz * yy, c_yz = xy * xz - yz * xx;
    const L determinant = xx * c_xx + (xy * c_xy + xz * c_xz);
    const Vec3<L> m{c_xx * t.x + (c_xy * t.y + c_xz * t.z), c_xy * t.x + (c_yy * t.y + c_yz * t.z),
                    c_xz * t.x + (c_yz * t.y + c_zz * t.z)};
    const L height_a_sq =
        L(pair_.squares_a.x) * (m.x * m.x) + (L(pair_.squares_a.y) * (m.y * m.y) + L(pair_.squares_a.z) * (m.z * m.z));
    const L m_p = dot(m, p), m_q = dot(m, q), m_r = dot(m, r);
    const L height_b_sq = m_p * m_p + (m_q * m_q + m_r * m_r);
    // The way between the centres along m, less the slack, against the sum of two roots, which are not taken.
    const L way = dot(m, t) - L(error_) * norm_1(m);
    const L beyond = way * way - (height_a_sq + height_b_sq);
    const PacketMask<W> disjoint =
        both(both(way > L(kNothing), beyond > L(0.0)), beyond * beyond > L(4.0) * (height_a_sq * height_b_sq));
    const L reached_sq = larger((of_a * of_a) * height_a_sq, (of_b * of_b) * height_b_sq);
    const L within = L(1.0 - 2.0 * PairFormula::kMargin) * determinant;
    return {disjoint, both(determinant > L(pair_.least_determinant), reached_sq < within * within)};
  }

 private:
  static constexpr double kNothing = 0x1p-200;

  PairFormula pair_;
  double error_;
};

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex

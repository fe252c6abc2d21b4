// The Minkowski difference K = A - B of one pair of bodies at many poses, as the packets' overlap search takes it:
// support points, a start, and what rounding may change of them (E1, E18).
#pragma once

#include <cstddef>

#include "engine/numeric/packet_memory.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/query/packets/packet_core.h"
#include "engine/query/packets/packet_overlap.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

// tests/bench compiles the kernel once more without the proofs, to measure what they cost.
#ifdef VEX_FILTER_WITHOUT_PROOFS
inline constexpr bool kProven = false;
#else
inline constexpr bool kProven = true;
#endif

/// E of E1 and E18, one for all poses of a pair that are not farther than kFarthestPacket.
inline double packet_error(const PacketPairForms& forms) {
  return kProven ? forms.own_error + 40.0 * kUnitRoundoff * ((1.0 + kFarthestPacket) * forms.own_reach) : 0.0;
}

/// Loops work on a copy of their own: a search's member would be read again after each store.
template <int W, class Core>
struct PacketDifference {
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Vec = Vec3<L>;

  static Transform<L> pose_at(const double* columns, std::size_t stride, std::size_t k) {
    const auto column = [&](std::size_t c) { return L::load(columns + c * stride + k); };
    return {{column(0), column(1), column(2)},
            {column(3), column(4), column(5)},
            {column(6), column(7), column(8)},
            {column(9), column(10), column(11)}};
  }

  explicit PacketDifference(const PacketPairForms& forms)
      : a(*forms.a),
        b(*forms.b),
        centre_b(forms.centre_b),
        b_is_central(forms.centre_b.x == 0.0 && forms.centre_b.y == 0.0 && forms.centre_b.z == 0.0),
        start(forms.centre_a + forms.start_offset),
        ball_radius(forms.ball_radius),
        own_reach(forms.own_reach),
        own_error(forms.own_error),
        farthest(kFarthestPacket * own_reach),
        error(packet_error(forms)),
        threshold(4.25 * error * ((own_reach + farthest) * (own_reach + farthest))),
        start_clearance(forms.start_clearance - 2.0 * error) {}

  /// Of a rotation the magnitudes add up to 5.2 at most; of NaNs and infinities to nothing below 8.
  Mask is_usual(const Transform<L>& pose) const {
    const L turn = norm_1(pose.row_x) + (norm_1(pose.row_y) + norm_1(pose.row_z));
    return both(turn < L(8.0), norm_1(pose.translation) < L(farthest));
  }

  Vec start_point(const Transform<L>& pose) const {
    if (b_is_central) return broadcast<L>(start) - pose.translation;
    return broadcast<L>(start) - pose(broadcast<L>(centre_b));
  }
  // Of the trials whose poses stand in these columns, of which no more is needed if B's centre is its origin.
  Vec start_point(const double* columns, std::size_t stride, std::size_t k) const {
    if (!b_is_central) return start_point(pose_at(columns, stride, k));
    const auto column = [&](std::size_t c) { return L::load(columns + c * stride + k); };
    return broadcast<L>(start) - Vec{column(9), column(10), column(11)};
  }

  Vec support(const Transform<L>& pose, const Vec& dir) const {
    const Vec p = b.support(-pose.direction_to_b(dir));
    Vec w = a.support(dir) - pose.translation;
    w = {((w.x - pose.row_x.x * p.x) - pose.row_x.y * p.y) - pose.row_x.z * p.z,
         ((w.y - pose.row_y.x * p.x) - pose.row_y.y * p.y) - pose.row_y.z * p.z,
         ((w.z - pose.row_z.x * p.x) - pose.row_z.y * p.y) - pose.row_z.z * p.z};
    if (ball_radius > 0.0) w = w + (L(ball_radius) / norm(dir)) * dir;
    return w;
  }

  // The origin is in the simplex: every determinant above what rounding and the points' own error could make of it.
  Mask encloses(const L& d0, const L& d23, const L& d31, const L& d12) const {
    const L least(threshold);
    return both(both(d0 > least, d23 > least), both(d31 > least, d12 > least));
  }

  // How far inside of K the origin is, where it is in that simplex (E18): its height over each face, or what the ball
  // about v0 has of it. `weight`: what v0 has of it at least.
  L clearance(const Vec& v0, const Vec& v1, const Vec& v2, const Vec& v3, const L& d0, const L& d23, const L& d31,
              const L& d12, L* weight) const {
    const Vec from_v0[] = {v1 - v0, v2 - v0, v3 - v0};
    const L reach(own_reach + farthest), unsure(threshold);
    const auto height = [&](const L& d, const Vec& normal) {
      return (d - unsure) / (L(1.0 + 0x1p-20) * norm(normal) + L(0x1p-40) * (reach * reach));
    };
    const L over_sides =
        smaller(height(d23, cross(from_v0[1], from_v0[2])),
                smaller(height(d31, cross(from_v0[2], from_v0[0])), height(d12, cross(from_v0[0], from_v0[1]))));
    *weight = (d0 - unsure) / (L(1.0 + 0x1p-20) * ((d0 + d23) + (d31 + d12)) + L(4.0) * unsure);
    return larger(smaller(height(d0, cross(v2 - v1, v3 - v1)), over_sides), *weight * L(start_clearance));
  }

  // Where v0 has at least this weight in the origin, a point of K on the other side of it, no farther than v0 is.
  static Vec beyond_origin(const Vec& v0, const L& weight) {
    const L of_v0 = smaller(weight, L(0.5));
    return (-of_v0 / (L(1.0) - of_v0)) * v0;
  }

  Core a, b;
  Vec3d centre_b;
  bool b_is_central;
  Vec3d start;
  double ball_radius, own_reach, own_error;
  double farthest, error, threshold;  // of all trials that are no farther than this
  double start_clearance;
};

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex

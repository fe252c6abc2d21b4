// The search of portal_refinement.h for many poses at once: the trials that are at the same step of it are taken
// together, a register full at a time, so that none waits for another's branch.
//
// Steps of a trial: a support point against the start (v1), one beside the ray from the start through the origin (v2),
// one across the wedge of these until the ray passes between (v3: a portal), and then one after the other in front of
// the portal (v4). The trials at a step stand in columns, one value a column; those that a step leaves open move up in
// place. What no step proves is left to the scalar search, with better conditioned faces and three starts, and to the
// exact stages behind it.
//
// Disjoint is proven as there (E1); overlapping by the four determinants of v0 ... v3, each above one bound for all
// (E18).
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/packet.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/query/packet_core.h"
#include "engine/query/packet_overlap.h"

namespace vex {
namespace VEX_ISA {

// tests/bench compiles the kernel once more without the proofs, to measure what they cost.
#ifdef VEX_FILTER_WITHOUT_PROOFS
inline constexpr bool kProven = false;
#else
inline constexpr bool kProven = true;
#endif

template <int W, class CoreA, class CoreB>
class PacketSearch {
 public:
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Vec = Vec3<L>;

  explicit PacketSearch(const PacketPairForms& forms)
      : a_(*forms.a),
        b_(*forms.b),
        centre_b_(forms.centre_b),
        b_is_central_(forms.centre_b.x == 0.0 && forms.centre_b.y == 0.0 && forms.centre_b.z == 0.0),
        start_(forms.centre_a + forms.start_offset),
        ball_radius_(forms.ball_radius),
        own_reach_(forms.own_reach),
        own_error_(forms.own_error) {}

  /// PacketOverlap::decide.
  __attribute__((flatten)) void decide(const double* poses, std::size_t stride, std::size_t n, PacketAnswer* answers) {
    answers_ = answers;
    for (std::size_t k = 0; k < n; ++k) answers[k] = PacketAnswer::open;
    n_wedge_ = 0;
    for (std::size_t k = 0; k < n; k += W) first_point(poses, stride, k, n);
    const std::size_t n_second = n_wedge_;
    n_wedge_ = 0;
    for (std::size_t k = 0; k < n_second; k += W) second_point(k, n_second);
    n_portal_ = 0;
    for (int round = 0; round < kMostWedges && n_wedge_ > 0; ++round) {
      const std::size_t n_now = n_wedge_;
      n_wedge_ = 0;
      for (std::size_t k = 0; k < n_now; k += W) third_point(k, n_now);
    }
    for (int round = 0; round < kMostPortals && n_portal_ > 0; ++round) {
      const std::size_t n_now = n_portal_;
      n_portal_ = 0;
      for (std::size_t k = 0; k < n_now; k += W) next_portal(k, n_now);
    }
  }

 private:
  static constexpr int kMostWedges = 8, kMostPortals = 16;
  // What is compressed may write a packet too far.
  static constexpr std::size_t kColumn = PacketOverlap::kMostTrials + W;

  // A packet's poses with what follows from them.
  struct Placed {
    Transform<L> pose;
    L error, threshold;
    Vec v0;
  };

  Placed placed(const double* poses, std::size_t stride, std::size_t first) const {
    const auto column = [&](std::size_t c) { return L::load(poses + c * stride + first); };
    Placed p;
    p.pose = {{column(0), column(1), column(2)},
              {column(3), column(4), column(5)},
              {column(6), column(7), column(8)},
              {column(9), column(10), column(11)}};
    if constexpr (kProven) {
      const L reach = L(own_reach_) + norm_1(p.pose.translation);
      p.error = L(own_error_) + L(40.0 * kUnitRoundoff) * reach;
      p.threshold = L(4.25) * p.error * (reach * reach);
    }
    p.v0 = b_is_central_ ? broadcast<L>(start_) - p.pose.translation
                         : broadcast<L>(start_) - p.pose(broadcast<L>(centre_b_));
    return p;
  }

  Vec support(const Placed& p, const Vec& dir) const {
    Vec w = a_.support(dir) - p.pose(b_.support(p.pose.direction_to_b(-dir)));
    if (ball_radius_ > 0.0) w = w + (L(ball_radius_) / norm(dir)) * dir;
    return w;
  }

  // A direction of a usual length, and what a height along it must exceed: an unusual one might lose the products with
  // it, or the squares of an ellipsoid's image, to underflow, and takes its trial out of the search (E18).
  struct Slack {
    Mask is_usual;
    L value;
  };
  static Slack slack_of(const Placed& p, const Vec& dir) {
    const L length = norm_1(dir);
    return {both(length > L(0x1p-200), length < L(0x1p200)), kProven ? p.error * length : L(0.0)};
  }

  // The lanes of a packet from `first` that are trials.
  static Mask trials(std::size_t first, std::size_t n) {
    return L::numbers_from(static_cast<double>(first)) < L(static_cast<double>(n));
  }

  void answer(const double* indices, const Mask& which, PacketAnswer value) {
    for (unsigned on = lanes_on(which); on != 0; on &= on - 1) {
      answers_[static_cast<std::size_t>(indices[__builtin_ctz(on)])] = value;
    }
  }

  static constexpr std::size_t kIndex = 12, kV1 = 13, kV2 = 16, kV3 = 19;

  static void store(double (*columns)[kColumn], std::size_t at, const Compaction<W>& move, std::size_t first,
                    const Vec& v) {
    move.store(columns[first] + at, v.x);
    move.store(columns[first + 1] + at, v.y);
    move.store(columns[first + 2] + at, v.z);
  }
  // The trials of `move` behind the n that stand in the columns: pose, index, v1 and as many points more as there are.
  template <class... Points>
  static void append(double (*columns)[kColumn], std::size_t& n, const Compaction<W>& move, const Transform<L>& pose,
                     const L& index, const Points&... points) {
    if (move.n() == 0) return;
    store(columns, n, move, 0, pose.row_x);
    store(columns, n, move, 3, pose.row_y);
    store(columns, n, move, 6, pose.row_z);
    store(columns, n, move, 9, pose.translation);
    move.store(columns[kIndex] + n, index);
    std::size_t column = kV1;
    ((store(columns, n, move, column, points), column += 3), ...);
    n += static_cast<std::size_t>(move.n());
  }
  static Vec load(const double (*columns)[kColumn], std::size_t at, std::size_t first) {
    return {L::load(columns[first] + at), L::load(columns[first + 1] + at), L::load(columns[first + 2] + at)};
  }

  void first_point(const double* poses, std::size_t stride, std::size_t k, std::size_t n) {
    const L index = L::numbers_from(static_cast<double>(k));
    const Placed p = placed(poses, stride, k);
    const Vec dir = -p.v0;
    const Slack slack = slack_of(p, dir);
    // Of a rotation the magnitudes add up to 5.2 at most; of NaNs and infinities to nothing below 8.
    const L turn = norm_1(p.pose.row_x) + (norm_1(p.pose.row_y) + norm_1(p.pose.row_z));
    const Mask is_within = both(turn < L(8.0), L(own_reach_) + norm_1(p.pose.translation) < L(kLargestPacketReach));
    const Mask is_trial = both(both(index < L(static_cast<double>(n)), is_within), slack.is_usual);
    const Vec w = support(p, dir);
    const Mask apart = both(is_trial, dot(dir, w) < -slack.value);
    for (unsigned on = lanes_on(apart); on != 0; on &= on - 1) {
      answers_[k + static_cast<std::size_t>(__builtin_ctz(on))] = PacketAnswer::disjoint;
    }
    append(wedges_, n_wedge_, Compaction<W>(but_not(is_trial, apart)), p.pose, index, w);
  }

  void second_point(std::size_t k, std::size_t n) {
    const Placed p = placed(wedges_[0], kColumn, k);
    const L index = L::load(wedges_[kIndex] + k);
    const Vec v1 = load(wedges_, k, kV1);
    const Vec dir = cross(v1, p.v0);
    const Vec w = support(p, dir);
    const Slack slack = slack_of(p, dir);
    const Mask is_trial = both(trials(k, n), slack.is_usual);
    const Mask apart = both(is_trial, dot(dir, w) < -slack.value);
    answer(wedges_[kIndex] + k, apart, PacketAnswer::disjoint);
    // Oriented so that the wedge's normal points to the origin's side.
    const Mask flips = dot(cross(v1, w), p.v0) > L(0.0);
    append(wedges_, n_wedge_, Compaction<W>(but_not(is_trial, apart)), p.pose, index, select<L>(flips, w, v1),
           select<L>(flips, v1, w));
  }

  // The origin is in the simplex: every determinant above what rounding and the points' own error could make of it.
  static Mask encloses(const Placed& p, const L& d0, const L& d23, const L& d31, const L& d12) {
    return both(both(d0 > p.threshold, d23 > p.threshold), both(d31 > p.threshold, d12 > p.threshold));
  }

  void third_point(std::size_t k, std::size_t n) {
    const Placed p = placed(wedges_[0], kColumn, k);
    const L index = L::load(wedges_[kIndex] + k);
    const Vec v1 = load(wedges_, k, kV1), v2 = load(wedges_, k, kV2);
    const Vec dir = cross(v1 - p.v0, v2 - p.v0);
    const Vec w = support(p, dir);
    const Slack slack = slack_of(p, dir);
    const Mask is_trial = both(trials(k, n), slack.is_usual);
    const Mask apart = both(is_trial, dot(dir, w) < -slack.value);
    const Vec c12 = cross(v1, v2), c23 = cross(v2, w), c31 = cross(w, v1);
    const L d23 = -dot(c23, p.v0), d31 = -dot(c31, p.v0), d12 = -dot(c12, p.v0);
    const Mask outside_13 = d31 < L(0.0);
    const Mask outside_23 = but_not(d23 < L(0.0), outside_13);
    const Mask turns = either(outside_13, outside_23);
    const Mask inside = but_not(both(is_trial, encloses(p, dot(v1, c23), d23, d31, d12)), turns);
    answer(wedges_[kIndex] + k, apart, PacketAnswer::disjoint);
    answer(wedges_[kIndex] + k, inside, PacketAnswer::overlap);
    const Mask goes_on = but_not(but_not(is_trial, apart), inside);
    append(wedges_, n_wedge_, Compaction<W>(both(goes_on, turns)), p.pose, index, select<L>(outside_23, w, v1),
           select<L>(outside_13, w, v2));
    append(portals_, n_portal_, Compaction<W>(but_not(goes_on, turns)), p.pose, index, v1, v2, w);
  }

  void next_portal(std::size_t k, std::size_t n) {
    const Placed p = placed(portals_[0], kColumn, k);
    const L index = L::load(portals_[kIndex] + k);
    Vec v1 = load(portals_, k, kV1), v2 = load(portals_, k, kV2), v3 = load(portals_, k, kV3);
    const Vec dir = cross(v2 - v1, v3 - v1);
    const Vec w = support(p, dir);
    const Slack slack = slack_of(p, dir);
    const Mask is_trial = both(trials(k, n), slack.is_usual);
    const L value = dot(dir, w);
    const Mask apart = both(is_trial, value < -slack.value);
    const Mask advances = (value - dot(dir, v1)) > slack.value;
    // The planes through v0, the origin and w split the portal in three; the ray passes one of the parts.
    const Vec w_v0 = cross(w, p.v0);
    const Mask past_1 = dot(v1, w_v0) > L(0.0), past_2 = dot(v2, w_v0) > L(0.0), past_3 = dot(v3, w_v0) > L(0.0);
    const Mask replaces_3 = but_not(past_1, past_2);
    const Mask replaces_2 = but_not(past_3, past_1);
    v1 = select<L>(either(replaces_2, replaces_3), v1, w);
    v2 = select<L>(replaces_2, w, v2);
    v3 = select<L>(replaces_3, w, v3);
    const Vec c12 = cross(v1, v2), c23 = cross(v2, v3), c31 = cross(v3, v1);
    const Mask inside = both(is_trial, encloses(p, dot(v1, c23), -dot(c23, p.v0), -dot(c31, p.v0), -dot(c12, p.v0)));
    answer(portals_[kIndex] + k, apart, PacketAnswer::disjoint);
    answer(portals_[kIndex] + k, inside, PacketAnswer::overlap);
    const Mask goes_on = both(but_not(but_not(is_trial, apart), inside), advances);
    append(portals_, n_portal_, Compaction<W>(goes_on), p.pose, index, v1, v2, v3);
  }

  CoreA a_;
  CoreB b_;
  Vec3d centre_b_;
  bool b_is_central_;
  Vec3d start_;
  double ball_radius_, own_reach_, own_error_;
  PacketAnswer* answers_ = nullptr;
  std::size_t n_wedge_ = 0, n_portal_ = 0;
  // Pose, index, points. A step reads a packet before it writes one, and writes no farther than it has read.
  alignas(64) double wedges_[19][kColumn] = {};
  alignas(64) double portals_[22][kColumn] = {};
};

}  // namespace VEX_ISA
}  // namespace vex

// The search of portal_refinement.h for many poses at once: the trials that are at the same step of it are taken
// together, a register full at a time, so that none waits for another's branch.
//
// Steps of a trial: a support point towards B, as A sees it (v1), one as B sees it or across the line of the start and
// v1 (v2), one across the wedge of these until the ray passes between (v3: a portal), and then one after the other in
// front of the portal (v4). The trials at a step stand in columns, one value a column; those that a step leaves open
// move up in place. What no step proves is left to the scalar search, with better conditioned faces and three starts,
// and to the exact stages behind it.
//
// Disjoint is proven as there (E1); overlapping by the four determinants of v0 ... v3, each above one bound for all
// (E18).
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/query/packets/packet_difference.h"
#include "engine/query/search/portal_split.h"

namespace vex {
namespace VEX_ISA {

template <int W, class Core>
class PacketSearch {
 public:
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Bits = PacketBits<W>;
  using Vec = Vec3<L>;

  explicit PacketSearch(const PacketPairForms& forms) : pair_(forms) {}

  /// PacketOverlap::decide; of clearances what is told in `kTells` searches.
  template <bool kTells>
  __attribute__((flatten)) void decide(const double* poses, std::size_t stride, std::size_t n, PacketAnswer* answers,
                                       PacketClearances* clearances) {
    for (std::size_t k = 0; k < n; ++k) answers[k] = PacketAnswer::open;
    n_ended_ = n_portal_ = 0;
    first_point<kTells>(poses, stride, n);
    second_point<kTells>();
    for (int round = 0; round < kMostWedges && n_wedge_ > 0; ++round) third_point<kTells>();
    for (int round = 1; round <= kMostPortals && n_portal_ > 0; ++round) next_portal<kTells>(round == kMostPortals);
    for (std::size_t k = 0; k < n_ended_; ++k) {
      std::uint64_t code;
      __builtin_memcpy(&code, &ended_[k], sizeof code);
      answers[code >> 2] = static_cast<PacketAnswer>(code & 3u);
      if constexpr (kTells) {
        const std::uint64_t row = code >> 2;
        for (std::size_t c = 0; c < 3; ++c) clearances->where[c][row] = ended_clearance_[c][k];
        clearances->length[row] = ended_clearance_[3][k] > 0.0 ? ended_clearance_[3][k] : 0.0;
        if ((code & 3u) != static_cast<std::uint64_t>(PacketAnswer::overlap)) continue;
        for (std::size_t c = 0; c < 9; ++c) clearances->corners[c][row] = ended_corners_[c][k];
      }
    }
  }

 private:
  using Pair = PacketDifference<W, Core>;

  static constexpr int kMostWedges = 8, kMostPortals = 16;
  // A portal is pushed outwards no more where its height is this much of K's.
  static constexpr double kNearSurface = 0.6;
  // A direction so short might lose the products with it, or the squares of an ellipsoid's image, to underflow, and
  // takes its trial out of the search (E18).
  static constexpr double kLeastLength = 0x1p-200;
  // What is compressed may write a packet too far.
  static constexpr std::size_t kColumn = PacketOverlap::kMostTrials + W;
  static constexpr std::size_t kCode = 12, kV1 = 13, kV2 = 16, kV3 = 19;

  static Vec load(const double (*columns)[kColumn], std::size_t first, std::size_t k) {
    return {L::load(columns[first] + k), L::load(columns[first + 1] + k), L::load(columns[first + 2] + k)};
  }
  static Mask load_mask(const double* from) { return mask_of(bits_of(L::load(from))); }

  // A step is two loops, so that neither runs out of registers, nor is its chain of operations longer than what a
  // processor sees at once. The first finds the support point of each trial along its direction, and whether that
  // separates the bodies (apart_); of the others onward_ has those whose direction was usual: whose point is to be
  // believed. clearance_ has the direction and the gap that it shows, where that is asked for.
  template <bool kTells>
  void set_found(std::size_t k, const Vec& dir, const Vec& w, const L& gap, const Mask& apart, const Mask& usual) {
    if constexpr (kTells) tell(k, dir, gap / (L(1.0 + 0x1p-40) * norm(dir)));
    w.x.store(w_[0] + k);
    w.y.store(w_[1] + k);
    w.z.store(w_[2] + k);
    from_bits(bits_of(apart)).store(apart_ + k);
    from_bits(bits_of(but_not(usual, apart))).store(onward_ + k);
  }
  void tell(std::size_t k, const Vec& where, const L& length) {
    where.x.store(clearance_[0] + k);
    where.y.store(clearance_[1] + k);
    where.z.store(clearance_[2] + k);
    length.store(clearance_[3] + k);
  }
  // Of trials whose simplex has the origin, at least what no length of theirs is below, and the weight of v0; of others
  // 0.
  L clearance_of(const Mask& inside, const Vec& v0, const Vec& v1, const Vec& v2, const Vec& v3, const L& d0,
                 const L& d23, const L& d31, const L& d12, L* weight) const {
    const L clearance = pair_.clearance(v0, v1, v2, v3, d0, d23, d31, d12, weight);
    *weight = select(inside, larger(*weight, L(0.0)), L(0.0));
    return select(inside, larger(clearance, L(0x1p-1000)), L(0.0));
  }
  template <bool kTells, class Direction, class Found>
  void find_points(const double (*columns)[kColumn], std::size_t n, const Direction& direction, const Found& found) {
    const Pair pair = pair_;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> pose = Pair::pose_at(columns[0], kColumn, k);
      const Vec dir = direction(pair, pose, k);
      const Vec w = pair.support(pose, dir);
      const L height = dot(dir, w), length = norm_1(dir);
      const L slack = L(pair.error) * length;
      const Mask is_usual = both(length > L(kLeastLength), Mask::first(n - k));
      set_found<kTells>(k, dir, w, -(height + slack), both(is_usual, height < -slack), is_usual);
      found(k, dir, height, slack);
    }
  }
  static constexpr auto kNothingMore = [](std::size_t, const Vec&, const L&, const L&) {};

  // The trials at k: a row, times four, and its answer, open till it ends; and the clearance that it leaves, with the
  // corners of the portal where it is one of overlapping bodies. Numbers that a loop counts up are its own variables: a
  // member would be read again after each store.
  template <bool kTells, class... Corners>
  void end(std::size_t& n_ended, std::size_t k, const Bits& code, const Mask& ends, const Mask& apart,
           const Mask& inside, const Corners&... corners) {
    const Compaction<W> move(ends);
    const Bits answer = (bits_of(apart) & Bits(static_cast<std::uint64_t>(PacketAnswer::disjoint))) |
                        (bits_of(inside) & Bits(static_cast<std::uint64_t>(PacketAnswer::overlap)));
    move.store(ended_ + n_ended, from_bits(code | answer));
    if constexpr (kTells) {
      for (std::size_t c = 0; c < 4; ++c) move.store(ended_clearance_[c] + n_ended, L::load(clearance_[c] + k));
      std::size_t column = 0;
      const auto put = [&](const Vec& corner) {
        move.store(ended_corners_[column++] + n_ended, corner.x);
        move.store(ended_corners_[column++] + n_ended, corner.y);
        move.store(ended_corners_[column++] + n_ended, corner.z);
      };
      (put(corners), ...);
    }
    n_ended += static_cast<std::size_t>(move.n());
  }

  // The trials of `move`, of those from k on, behind the n that stand in the columns: pose, code and points.
  template <class... Points>
  static void append(double (*columns)[kColumn], std::size_t& n, const Compaction<W>& move, const double* poses,
                     std::size_t stride, std::size_t k, const Bits& code, const Points&... points) {
    for (std::size_t c = 0; c < kCode; ++c) move.store(columns[c] + n, L::load(poses + c * stride + k));
    move.store(columns[kCode] + n, from_bits(code));
    std::size_t column = kV1;
    const auto put = [&](const Vec& point) {
      move.store(columns[column++] + n, point.x);
      move.store(columns[column++] + n, point.y);
      move.store(columns[column++] + n, point.z);
    };
    (put(points), ...);
    n += static_cast<std::size_t>(move.n());
  }

  template <bool kTells>
  void first_point(const double* poses, std::size_t stride, std::size_t n) {
    const Pair pair = pair_;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> pose = Pair::pose_at(poses, stride, k);
      const Vec v0 = pair.start_point(pose);
      const Vec dir = usual(pair.a.direction_to(broadcast<L>(pair.start) - v0), -v0);
      const L distance = norm_1(pose.translation), length = norm_1(dir);
      const L reach = L(pair.own_reach) + distance;
      const L slack = kProven ? (L(pair.own_error) + L(40.0 * kUnitRoundoff) * reach) * length : L(0.0);
      // Of a rotation the magnitudes add up to 5.2 at most; of NaNs and infinities to nothing below 8.
      const L turn = norm_1(pose.row_x) + (norm_1(pose.row_y) + norm_1(pose.row_z));
      const Mask is_usual =
          both(both(turn < L(8.0), reach < L(kLargestPacketReach)), both(length > L(kLeastLength), Mask::first(n - k)));
      const Vec w = pair.support(pose, dir);
      const L height = dot(dir, w);
      set_found<kTells>(k, dir, w, -(height + slack), both(is_usual, height < -slack),
                        both(is_usual, distance < L(pair.farthest)));
    }
    std::size_t n_ended = 0, n_wedge = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Bits code = Bits::numbers_from(k) << 2;
      const Mask onward = load_mask(onward_ + k);
      end<kTells>(n_ended, k, code, but_not(Mask::first(n - k), onward), load_mask(apart_ + k), Mask(false));
      append(wedges_, n_wedge, Compaction<W>(onward), poses, stride, k, code, load(w_, 0, k));
    }
    n_ended_ = n_ended;
    n_wedge_ = n_wedge;
  }

  // `dir`, unless it is nothing beside the other.
  static Vec usual(const Vec& dir, const Vec& otherwise) {
    return select<L>(norm_1(dir) > L(0x1p-20) * norm_1(otherwise), dir, otherwise);
  }

  // Along B's own direction to A; where it shows none, or one that leads to the first point again, across the line from
  // the start through that point.
  template <bool kTells>
  void second_point() {
    const auto across = [](const double(*columns)[kColumn]) {
      return [columns](const Pair& pair, const Transform<L>& pose, std::size_t k) {
        return cross(load(columns, kV1, k), pair.start_point(pose));
      };
    };
    const std::size_t n = n_wedge_;
    n_wedge_ = 0;
    if (!pair_.b.has_direction()) {
      span_wedges<kTells>(wedges_, n, across(wedges_));
      return;
    }
    const auto from_b = [](const Pair& pair, const Transform<L>& pose, std::size_t) -> Vec {
      const Vec v0 = pair.start_point(pose);
      const Vec p = pair.b.direction_to(pose.direction_to_b(v0) + broadcast<L>(pair.centre_b));
      return usual({-dot(pose.row_x, p), -dot(pose.row_y, p), -dot(pose.row_z, p)}, -v0);
    };
    span_wedges<kTells>(wedges_, n, from_b);
    const std::size_t n_again = n_portal_;
    n_portal_ = 0;
    span_wedges<kTells>(portals_, n_again, across(portals_));
  }
  // What spans no wedge with the start and the first point goes to portals_, where nothing else is yet.
  template <bool kTells, class Direction>
  void span_wedges(const double (*columns)[kColumn], std::size_t n, const Direction& direction) {
    find_points<kTells>(columns, n, direction, kNothingMore);
    const Pair pair = pair_;
    const bool is_last = columns == portals_ || !pair.b.has_direction();
    std::size_t n_ended = n_ended_, n_wedge = n_wedge_, n_again = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Vec v0 = pair.start_point(columns[0], kColumn, k), v1 = load(columns, kV1, k), w = load(w_, 0, k);
      // Oriented so that the wedge's normal points to the origin's side.
      const Vec across = cross(v1, v0);
      const L side = dot(across, w);
      const Mask flips = side < L(0.0);
      const Mask onward = load_mask(onward_ + k);
      const Mask is_flat = is_last ? Mask(false) : absolute(side) < (L(0x1p-30) * norm_1(across)) * norm_1(w);
      const Bits code = bits_of(L::load(columns[kCode] + k));
      end<kTells>(n_ended, k, code, but_not(Mask::first(n - k), onward), load_mask(apart_ + k), Mask(false));
      if (!is_last) append(portals_, n_again, Compaction<W>(both(onward, is_flat)), columns[0], kColumn, k, code, v1);
      append(wedges_, n_wedge, Compaction<W>(but_not(onward, is_flat)), columns[0], kColumn, k, code,
             select<L>(flips, w, v1), select<L>(flips, v1, w));
    }
    n_ended_ = n_ended;
    n_wedge_ = n_wedge;
    if (!is_last) n_portal_ = n_again;
  }

  template <bool kTells>
  void third_point() {
    const std::size_t n = n_wedge_;
    const auto direction = [this](const Pair& pair, const Transform<L>& pose, std::size_t k) {
      const Vec v0 = pair.start_point(pose);
      return cross(load(wedges_, kV1, k) - v0, load(wedges_, kV2, k) - v0);
    };
    find_points<kTells>(wedges_, n, direction, kNothingMore);
    const Pair pair = pair_;
    std::size_t n_ended = n_ended_, n_wedge = 0, n_portal = n_portal_;
    for (std::size_t k = 0; k < n; k += W) {
      const Vec v0 = pair.start_point(wedges_[0], kColumn, k), v1 = load(wedges_, kV1, k), v2 = load(wedges_, kV2, k);
      const Vec w = load(w_, 0, k);
      const Vec face = cross(v1, v2), w_v0 = cross(w, v0);
      const L d23 = -dot(w_v0, v2), d31 = dot(w_v0, v1);
      const Mask outside_13 = d31 < L(0.0);
      const Mask outside_23 = but_not(d23 < L(0.0), outside_13);
      const Mask turns = either(outside_13, outside_23);
      const Mask may = load_mask(onward_ + k);
      const L d0 = dot(w, face), d12 = -dot(face, v0);
      const Mask inside = both(may, pair.encloses(d0, d23, d31, d12));
      const Mask onward = kTells ? may : but_not(may, inside);
      const Bits code = bits_of(L::load(wedges_[kCode] + k));
      end<kTells>(n_ended, k, code, but_not(Mask::first(n - k), onward), load_mask(apart_ + k), inside);
      const Compaction<W> passed(but_not(onward, turns));
      if constexpr (kTells) {
        L weight;
        passed.store(portal_clearance_ + n_portal, clearance_of(inside, v0, v1, v2, w, d0, d23, d31, d12, &weight));
        passed.store(portal_weight_ + n_portal, weight);
      }
      append(portals_, n_portal, passed, wedges_[0], kColumn, k, code, v1, v2, w);
      append(wedges_, n_wedge, Compaction<W>(both(onward, turns)), wedges_[0], kColumn, k, code,
             select<L>(outside_23, w, v1), select<L>(outside_13, w, v2));
    }
    n_ended_ = n_ended;
    n_wedge_ = n_wedge;
    n_portal_ = n_portal;
  }

  // Of trials whose clearance is asked for, those whose simplex has the origin go on with it (portal_clearance_ is
  // above 0 then), until the portal is as near to the surface as it pays, or to the last round.
  template <bool kTells>
  void next_portal(bool is_last) {
    const std::size_t n = n_portal_;
    const auto direction = [this](const Pair&, const Transform<L>&, std::size_t k) {
      const Vec v1 = load(portals_, kV1, k);
      return cross(load(portals_, kV2, k) - v1, load(portals_, kV3, k) - v1);
    };
    // Where the height is not beyond the portal's own the search is at its end.
    find_points<kTells>(portals_, n, direction, [this](std::size_t k, const Vec& dir, const L& height, const L& slack) {
      const L own = dot(dir, load(portals_, kV1, k));
      from_bits(bits_of(height - own > slack)).store(advances_ + k);
      if constexpr (kTells) from_bits(bits_of(own < L(kNearSurface) * height)).store(is_far_ + k);
    });
    const Pair pair = pair_;
    std::size_t n_ended = n_ended_, n_portal = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Vec v0 = pair.start_point(portals_[0], kColumn, k), w = load(w_, 0, k);
      const Vec w_v0 = cross(w, v0);
      const Vec v1 = load(portals_, kV1, k), v2 = load(portals_, kV2, k), v3 = load(portals_, kV3, k);
      const PortalPart<L> part = part_passed(split_portal(v1, v2, v3, w_v0), v1, v2, v3);
      const Vec &left = part.left, &right = part.right;
      const Vec face = cross(left, right);
      const Mask usual = load_mask(onward_ + k);
      const L d0 = dot(w, face), d23 = -part.past_right, d31 = part.past_left, d12 = -dot(face, v0);
      Mask inside = both(usual, pair.encloses(d0, d23, d31, d12));
      Mask ends = inside;
      L clearance, weight;
      if constexpr (kTells) {
        clearance = larger(L::load(portal_clearance_ + k),
                           clearance_of(inside, v0, left, right, w, d0, d23, d31, d12, &weight));
        weight = larger(L::load(portal_weight_ + k), weight);
        inside = clearance > L(0.0);
        ends = is_last ? inside : but_not(inside, load_mask(is_far_ + k));
        tell(k, select<L>(inside, Pair::beyond_origin(v0, weight), load(clearance_, 0, k)),
             select(inside, clearance, L::load(clearance_[3] + k)));
      }
      const Mask onward = but_not(both(usual, load_mask(advances_ + k)), ends);
      const Bits code = bits_of(L::load(portals_[kCode] + k));
      end<kTells>(n_ended, k, code, but_not(Mask::first(n - k), onward), load_mask(apart_ + k), inside, left, right, w);
      const Compaction<W> passed(onward);
      if constexpr (kTells) {
        passed.store(portal_clearance_ + n_portal, clearance);
        passed.store(portal_weight_ + n_portal, weight);
      }
      append(portals_, n_portal, passed, portals_[0], kColumn, k, code, left, right, w);
    }
    n_ended_ = n_ended;
    n_portal_ = n_portal;
  }

  Pair pair_;
  std::size_t n_ended_ = 0, n_wedge_ = 0, n_portal_ = 0;
  // Pose, code, points. A step reads a packet before it writes one, and writes no farther than it has read.
  alignas(64) double wedges_[19][kColumn] = {};
  alignas(64) double portals_[22][kColumn] = {};
  alignas(64) double ended_[kColumn] = {}, ended_clearance_[4][kColumn] = {}, ended_corners_[9][kColumn] = {};
  // Of a step: support points, truth values as the bits of doubles, and directions with the clearance that they show.
  alignas(64) double w_[3][kColumn] = {}, apart_[kColumn] = {}, onward_[kColumn] = {}, advances_[kColumn] = {};
  alignas(64) double clearance_[4][kColumn] = {}, portal_clearance_[kColumn] = {},
                     portal_weight_[kColumn] = {}, is_far_[kColumn] = {};
};

}  // namespace VEX_ISA
}  // namespace vex

// The steps of radial_steps.h for many rays at once: those at the same step stand in columns, as in packet_search.h.
//
// Steps of a ray: three support points along the normals it comes with, a portal if the ray passes between them;
// otherwise two points on both sides of it and one across their wedge until it does. Then portals narrow, until the
// bounds meet, or are near enough for the pick to decide the rest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/packet_memory.h"
#include "engine/numeric/rounding.h"
#include "engine/query/packets/any_core.h"
#include "engine/sampling/radial/radial_packets.h"
#include "engine/sampling/radial/radial_steps.h"

namespace vex {
namespace VEX_ISA {

template <int W>
class RadialSearch {
 public:
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Bits = PacketBits<W>;
  using Vec = Vec3<L>;

  RadialSearch(const PacketPairForms& forms, const BodyPoints& points) : pair_(forms, points) {}

  /// PacketRays::find, close_in and decide.
  __attribute__((flatten)) void find(const RayTable& rays, RadialAnswers& answers) {
    search(rays, answers);
    for (std::size_t k = 0; k < n_near_; ++k) {
      const double pick = rays.columns[RayTable::kPick * rays.stride + row_at(near_[kRow], k)];
      near_[kAsked][k] = near_[kInner][k] + pick * (near_[kOuter][k] - near_[kInner][k]);
    }
    finish(answers);
  }
  __attribute__((flatten)) void close_in(const RayTable& rays, RadialAnswers& answers) {
    search(rays, answers);
    for (std::size_t k = 0; k < n_near_; ++k) leave_open(near_[kRow], near_[kInner], near_[kOuter], k, answers);
  }
  __attribute__((flatten)) void decide(RadialAnswers& answers) {
    for (std::size_t k = 0; k < n_near_; ++k) near_[kAsked][k] = answers.asked[row_at(near_[kRow], k)];
    finish(answers);
  }

 private:
  static constexpr int kMostWedges = 16, kMostPortals = 48;
  // What is compressed may write a packet too far.
  static constexpr std::size_t kColumn = PacketRays::kMostRays + W;
  // R, direction, row; then points; then of near bounds the cubes of these, and the one between them that is asked for.
  static constexpr std::size_t kDir = 9, kRow = 12, kV1 = 13, kV2 = 16, kV3 = 19, kInner = 22, kOuter = 23, kAsked = 24;

  static Vec load(const double (*columns)[kColumn], std::size_t first, std::size_t k) {
    return {L::load(columns[first] + k), L::load(columns[first + 1] + k), L::load(columns[first + 2] + k)};
  }
  static Portal<L> load_portal(const double (*columns)[kColumn], std::size_t k) {
    return {load(columns, kV1, k), load(columns, kV2, k), load(columns, kV3, k)};
  }
  static Transform<L> rotation_of(const double* columns, std::size_t stride, std::size_t k) {
    const auto column = [&](std::size_t c) { return L::load(columns + c * stride + k); };
    return {{column(0), column(1), column(2)},
            {column(3), column(4), column(5)},
            {column(6), column(7), column(8)},
            {L(0.0), L(0.0), L(0.0)}};
  }
  static Mask load_mask(const double* from) { return mask_of(bits_of(L::load(from))); }
  static void store_mask(double* to, const Mask& mask) { from_bits(bits_of(mask)).store(to); }
  static L cube(const L& x) { return x * x * x; }

  // What is known of the two bodies. Loops work on a copy of their own: a member would be read again after each store.
  struct Pair {
    Pair(const PacketPairForms& forms, const BodyPoints& body_points)
        : a(*forms.a),
          b(*forms.b),
          points(body_points),
          ball_radius(forms.ball_radius),
          error{forms.own_error + 80.0 * kUnitRoundoff * forms.own_reach, 2.0 * forms.own_reach} {}

    Vec support(const Transform<L>& rotation, const Vec& dir) const {
      const Vec at_b = b.support(-rotation.direction_to_b(dir)) - broadcast<L>(points.of_b);
      Vec w = (a.support(dir) - broadcast<L>(points.of_a)) -
              Vec{dot(rotation.row_x, at_b), dot(rotation.row_y, at_b), dot(rotation.row_z, at_b)};
      if (ball_radius > 0.0) w = w + (L(ball_radius) / norm(dir)) * dir;
      return w;
    }

    AnyCore a, b;
    BodyPoints points;
    double ball_radius;
    RadialError error;
  };

  static std::size_t row_at(const double* rows, std::size_t k) {
    std::uint64_t row;
    __builtin_memcpy(&row, rows + k, sizeof row);
    return row;
  }
  static void leave_open(const double* rows, const double* inner, const double* outer, std::size_t k,
                         RadialAnswers& answers) {
    const std::size_t row = row_at(rows, k);
    answers.inner[row] = inner[k];
    answers.outer[row] = outer[k];
  }

  // Until all bounds have met or are near, or the search has ended.
  void search(const RayTable& rays, RadialAnswers& answers) {
    answers.open_all(rays.n);
    n_ended_ = n_wedge_ = n_portal_ = n_near_ = n_lost_ = 0;
    first_portal(rays);
    span_wedges();
    for (int round = 0; round < kMostWedges && n_wedge_ > 0; ++round) turn_wedges();
    for (int round = 0; round < kMostPortals && n_portal_ > 0; ++round) narrow();
    tell_ended(answers);
  }
  void finish(RadialAnswers& answers) {
    for (int round = 0; round < kMostPortals && n_near_ > 0; ++round) ask_near();
    tell_ended(answers);
    for (std::size_t k = 0; k < n_lost_; ++k) leave_open(lost_[0], lost_[1], lost_[2], k, answers);
    for (std::size_t k = 0; k < n_near_; ++k) leave_open(near_[kRow], near_[kInner], near_[kOuter], k, answers);
  }
  void tell_ended(RadialAnswers& answers) {
    for (std::size_t k = 0; k < n_ended_; ++k) answers.cube[row_at(ended_[0], k)] = ended_[1][k];
    n_ended_ = 0;
  }

  void end(std::size_t& n_ended, const L& row, const L& value, const Mask& ends) {
    const Compaction<W> move(ends);
    move.store(ended_[0] + n_ended, row);
    move.store(ended_[1] + n_ended, value);
    n_ended += static_cast<std::size_t>(move.n());
  }

  // The rays of `move`, of those from k on, behind the n that stand in the columns: rotation, direction, row; then
  // these.
  template <class... Values>
  static void append(double (*columns)[kColumn], std::size_t& n, const Compaction<W>& move, const double* from,
                     std::size_t stride, std::size_t k, const L& row, const Values&... values) {
    for (std::size_t c = 0; c < kRow; ++c) move.store(columns[c] + n, L::load(from + c * stride + k));
    move.store(columns[kRow] + n, row);
    std::size_t column = kV1;
    (put(columns, n, move, column, values), ...);
    n += static_cast<std::size_t>(move.n());
  }
  static void put(double (*columns)[kColumn], std::size_t n, const Compaction<W>& move, std::size_t& column,
                  const L& value) {
    move.store(columns[column++] + n, value);
  }
  static void put(double (*columns)[kColumn], std::size_t n, const Compaction<W>& move, std::size_t& column,
                  const Vec& v) {
    put(columns, n, move, column, v.x);
    put(columns, n, move, column, v.y);
    put(columns, n, move, column, v.z);
  }
  static void put(double (*columns)[kColumn], std::size_t n, const Compaction<W>& move, std::size_t& column,
                  const Portal<L>& p) {
    put(columns, n, move, column, p.v1);
    put(columns, n, move, column, p.v2);
    put(columns, n, move, column, p.v3);
  }

  // The support points of three normals; whose triangle is no portal begins with two points beside the ray.
  void first_portal(const RayTable& rays) {
    const Pair pair = pair_;
    std::size_t n_portal = 0, n_wedge = 0;
    for (std::size_t k = 0; k < rays.n; k += W) {
      const auto column = [&](std::size_t c) { return L::load(rays.columns + c * rays.stride + k); };
      const auto vec = [&](std::size_t c) { return Vec{column(c), column(c + 1), column(c + 2)}; };
      const Transform<L> rotation = rotation_of(rays.columns, rays.stride, k);
      const Vec dir = vec(RayTable::kDirection), first = vec(RayTable::kNormals);
      const Vec second = vec(RayTable::kNormals + 3), third = vec(RayTable::kNormals + 6);
      const Portal<L> portal{pair.support(rotation, first), pair.support(rotation, second),
                             pair.support(rotation, third)};
      const Mask rays_here = Mask::first(rays.n - k), is_there = both(rays_here, is_portal(portal, dir, pair.error));
      const L row = from_bits(Bits::numbers_from(k));
      append(portals_, n_portal, Compaction<W>(is_there), rays.columns, rays.stride, k, row, portal);
      append(wedges_, n_wedge, Compaction<W>(but_not(rays_here, is_there)), rays.columns, rays.stride, k, row,
             first + second + third);
    }
    n_portal_ = n_portal;
    n_wedge_ = n_wedge;
  }

  void span_wedges() {
    const Pair pair = pair_;
    const std::size_t n = n_wedge_;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> rotation = rotation_of(wedges_[0], kColumn, k);
      const Vec dir = load(wedges_, kDir, k);
      const Vec v1 = pair.support(rotation, load(wedges_, kV1, k));
      Vec v2 = pair.support(rotation, towards_ray(v1, dir));
      // In a plane with the ray, as opposite points are: none of the wedge's sides is the ray's.
      const Mask is_flat = negation(absolute(turn_of(v1, v2, dir)) > pair.error.of_turn(dir));
      if (any(is_flat)) v2 = select<L>(is_flat, pair.support(rotation, cross(v1, dir)), v2);
      const Mask swaps = turn_of(v1, v2, dir) < L(0.0);
      store(wedges_, kV1, k, select<L>(swaps, v2, v1));
      store(wedges_, kV2, k, select<L>(swaps, v1, v2));
    }
  }
  static void store(double (*columns)[kColumn], std::size_t first, std::size_t k, const Vec& v) {
    v.x.store(columns[first] + k);
    v.y.store(columns[first + 1] + k);
    v.z.store(columns[first + 2] + k);
  }

  void turn_wedges() {
    const Pair pair = pair_;
    const std::size_t n = n_wedge_;
    std::size_t n_wedge = 0, n_portal = n_portal_;
    for (std::size_t k = 0; k < n; k += W) {
      const Vec dir = load(wedges_, kDir, k), v1 = load(wedges_, kV1, k), v2 = load(wedges_, kV2, k);
      const Vec v3 = pair.support(rotation_of(wedges_[0], kColumn, k), cross(v1, v2));
      const Wedge<L> wedge = turned(v1, v2, v3, dir);
      const Mask rays = Mask::first(n - k);
      // One whose corners are in a plane with the ray stays without an answer.
      const Mask is_there = both(but_not(rays, wedge.turns), is_portal(Portal<L>{v1, v2, v3}, dir, pair.error));
      const L row = L::load(wedges_[kRow] + k);
      append(portals_, n_portal, Compaction<W>(is_there), wedges_[0], kColumn, k, row, v1, v2, v3);
      append(wedges_, n_wedge, Compaction<W>(both(rays, wedge.turns)), wedges_[0], kColumn, k, row, wedge.v1, wedge.v2);
    }
    n_wedge_ = n_wedge;
    n_portal_ = n_portal;
  }

  // Of every portal in the columns its support point and the bounds. In a loop of its own: see packet_search.h.
  void find_sections(const double (*columns)[kColumn], std::size_t n) {
    const Pair pair = pair_;
    for (std::size_t k = 0; k < n; k += W) {
      const Portal<L> portal = load_portal(columns, k);
      const Vec normal = normal_of(portal);
      const Vec w = pair.support(rotation_of(columns[0], kColumn, k), normal);
      const RadialSection<L> found = section(portal, normal, w, load(columns, kDir, k), pair.error);
      w.x.store(w_[0] + k);
      w.y.store(w_[1] + k);
      w.z.store(w_[2] + k);
      found.lower.store(lower_ + k);
      found.upper.store(upper_ + k);
      store_mask(sound_ + k, both(found.is_sound, Mask::first(n - k)));
    }
  }

  void narrow() {
    const std::size_t n = n_portal_;
    const RadialError error = pair_.error;
    find_sections(portals_, n);
    std::size_t n_ended = n_ended_, n_portal = 0, n_near = n_near_;
    for (std::size_t k = 0; k < n; k += W) {
      const L lower = L::load(lower_ + k), upper = L::load(upper_ + k), gap = upper - lower;
      const L inner = cube(lower), outer = cube(upper);
      const Mask sound = load_mask(sound_ + k);
      const Mask meets = both(sound, gap <= L(kRadialRounding) * upper);
      const NarrowedPortal<L> next = narrowed(load_portal(portals_, k), load(w_, 0, k), load(portals_, kDir, k), error);
      const Mask is_left = both(but_not(sound, meets), next.is_sound);
      const Mask is_near = both(is_left, gap <= L(kRadialGap) * upper);
      const Mask goes_on = but_not(is_left, is_near);
      const L row = L::load(portals_[kRow] + k);
      end(n_ended, row, inner, meets);
      if (any(is_near)) {
        append(near_, n_near, Compaction<W>(is_near), portals_[0], kColumn, k, row, next.portal, inner, outer);
      }
      append(portals_, n_portal, Compaction<W>(goes_on), portals_[0], kColumn, k, row, next.portal);
    }
    n_ended_ = n_ended;
    n_portal_ = n_portal;
    n_near_ = n_near;
  }

  void ask_near() {
    const std::size_t n = n_near_;
    const RadialError error = pair_.error;
    find_sections(near_, n);
    std::size_t n_ended = n_ended_, n_lost = n_lost_, n_near = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const L lower = L::load(lower_ + k), upper = L::load(upper_ + k);
      const L inner = L::load(near_[kInner] + k), outer = L::load(near_[kOuter] + k),
              asked = L::load(near_[kAsked] + k);
      const Mask sound = load_mask(sound_ + k);
      const Mask is_inside = both(sound, cube(lower) >= asked);
      const Mask is_outside = but_not(both(sound, cube(upper) <= asked), is_inside);
      // Between bounds that have met the one asked for is the cube itself.
      const Mask meets =
          but_not(but_not(both(sound, upper - lower <= L(kRadialRounding) * upper), is_inside), is_outside);
      const L row = L::load(near_[kRow] + k);
      const NarrowedPortal<L> next = narrowed(load_portal(near_, k), load(w_, 0, k), load(near_, kDir, k), error);
      const Mask is_answered = either(either(is_inside, is_outside), meets);
      const Mask goes_on = but_not(both(sound, next.is_sound), is_answered);
      end(n_ended, row, select(is_inside, outer, select(is_outside, inner, asked)), is_answered);
      const Compaction<W> lost(but_not(but_not(Mask::first(n - k), is_answered), goes_on));
      lost.store(lost_[0] + n_lost, row);
      lost.store(lost_[1] + n_lost, inner);
      lost.store(lost_[2] + n_lost, outer);
      n_lost += static_cast<std::size_t>(lost.n());
      append(near_, n_near, Compaction<W>(goes_on), near_[0], kColumn, k, row, next.portal, inner, outer, asked);
    }
    n_ended_ = n_ended;
    n_lost_ = n_lost;
    n_near_ = n_near;
  }

  Pair pair_;
  std::size_t n_ended_ = 0, n_wedge_ = 0, n_portal_ = 0, n_near_ = 0, n_lost_ = 0;
  // A step reads a packet before it writes one, and writes no farther than it has read.
  alignas(64) double wedges_[kV3][kColumn] = {};
  alignas(64) double portals_[kInner][kColumn] = {};
  alignas(64) double near_[kAsked + 1][kColumn] = {};
  alignas(64) double ended_[2][kColumn] = {};  // row and cube
  alignas(64) double lost_[3][kColumn] = {};   // row and bounds of those that were near
  // Of a step: support points, bounds, and truth values as the bits of doubles.
  alignas(64) double w_[3][kColumn] = {}, lower_[kColumn] = {}, upper_[kColumn] = {}, sound_[kColumn] = {};
};

}  // namespace VEX_ISA
}  // namespace vex

// The radial function of a convex body K that holds the origin: r(d) = max {r : r d in K} (R. Schneider, Convex Bodies,
// 2nd ed., section 1.7), between two bounds, by the portals of portal_refinement.h.
//
// A portal is a triangle of points of K that the ray along d passes, taken so that det(v1, v2, v3) > 0. The ray is in
// K as far as the triangle's plane, n . x = n . v1, and leaves K before the plane of the support point w of its normal
// n, n . x = n . w. Then w takes the place of one of the three, and the bounds close in. On a polytope they meet after
// finitely many steps, when w is no farther than the portal.
//
// Bounds hold in the presence of rounding (E19): of points that are within E of K, a triangle is believed to be a
// portal only where every determinant exceeds what E could make of it.
//
// These are the steps, over lanes; who takes them, and when he ends, is told in radial_function.cpp (one ray) and
// radial_search.h (many).
#pragma once

#include "engine/numeric/vec3.h"
#include "engine/query/search/portal_split.h"

namespace vex {

/// Bounds count as one where they are this close, relative; rounding adds less to each (E19).
inline constexpr double kRadialRounding = 0x1p-26;

/// How far the normals of the first triangle lean from that of the ray, as a tangent, in the frame where K is most like
/// a ball: with it boxes need the fewest support calls of 0.3 ... 1.3 that were tried, all else nearly so.
inline constexpr double kRadialSpread = 0.7;

/// What a search knows of its own rounding (E19). Lengths.
struct RadialError {
  double support;  // E: support points are within it of K, heights along n within it times the 1-norm of n
  double reach;    // of the support points

  /// Above it the sign of a determinant of two points and the direction is that of points of K.
  template <class L>
  L of_turn(const Vec3<L>& dir) const {
    return L(2.25 * support * reach) * norm_1(dir);
  }
};

template <class L>
struct Portal {
  Vec3<L> v1, v2, v3;
};

/// Positive where v1, v2 and d turn as a portal's corners do.
template <class L>
L turn_of(const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& dir) {
  return dot(cross(v1, v2), dir);
}

/// Whether the ray passes the triangle, and the right way round, beyond doubt.
template <class L>
MaskOf<L> is_portal(const Portal<L>& p, const Vec3<L>& dir, const RadialError& error) {
  const L least = error.of_turn(dir);
  return both(both(turn_of(p.v1, p.v2, dir) > least, turn_of(p.v2, p.v3, dir) > least),
              turn_of(p.v3, p.v1, dir) > least);
}

/// From a point beside the ray to the ray, at a right angle to it; times |d|^2.
template <class L>
Vec3<L> towards_ray(const Vec3<L>& point, const Vec3<L>& dir) {
  return dot(point, dir) * dir - dot(dir, dir) * point;
}

/// The wedge of v1 and v2, which hold the ray between them, and the support point v3 of cross(v1, v2): either a portal,
/// or v3 takes the place of the one that is on the far side of it.
template <class L>
struct Wedge {
  Vec3<L> v1, v2;
  MaskOf<L> turns;
};
template <class L>
Wedge<L> turned(const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& v3, const Vec3<L>& dir) {
  const L zero(0.0);
  const MaskOf<L> beyond_1 = turn_of(v1, v3, dir) > zero;
  const MaskOf<L> beyond_2 = but_not(turn_of(v3, v2, dir) > zero, beyond_1);
  return {select<L>(beyond_2, v3, v1), select<L>(beyond_1, v3, v2), either(beyond_1, beyond_2)};
}

template <class L>
Vec3<L> normal_of(const Portal<L>& p) {
  return cross(p.v2 - p.v1, p.v3 - p.v1);
}

/// Between which the ray leaves K, in units of |d|.
template <class L>
struct RadialSection {
  L lower, upper;
  MaskOf<L> is_sound;  // each is right to within kRadialRounding / 2 of itself
};

/// `w`: the support point along `normal`, the portal's.
template <class L>
RadialSection<L> section(const Portal<L>& p, const Vec3<L>& normal, const Vec3<L>& w, const Vec3<L>& dir,
                         const RadialError& error) {
  const L at_1 = dot(normal, p.v1), at_2 = dot(normal, p.v2), at_3 = dot(normal, p.v3);
  // Of three numbers that are one but for rounding the least.
  const L at_12 = select(at_2 < at_1, at_2, at_1), inner = select(at_3 < at_12, at_3, at_12);
  const L outer = dot(normal, w), along = dot(normal, dir), length = norm_1(normal);
  const MaskOf<L> is_sound = both(L(error.support) * length < L(0.25 * kRadialRounding) * inner,
                                  L(0x1p-50) * (length * norm_1(dir)) < L(0.25 * kRadialRounding) * along);
  return {inner / along, outer / along, is_sound};
}

/// The part of the portal, split by w in three, that the ray passes: w and the two corners beside it.
template <class L>
struct NarrowedPortal {
  Portal<L> portal;
  MaskOf<L> is_sound;  // a portal beyond doubt, if the one before was
};
template <class L>
NarrowedPortal<L> narrowed(const Portal<L>& p, const Vec3<L>& w, const Vec3<L>& dir, const RadialError& error) {
  // The ray has no beginning, so v0 is -dir.
  const PortalPart<L> part = part_passed(split_portal(p.v1, p.v2, p.v3, cross(dir, w)), p.v1, p.v2, p.v3);
  const L least = error.of_turn(dir);
  return {{part.left, part.right, w}, both(part.past_left > least, -part.past_right > least)};
}

}  // namespace vex

// GJK overlap by portal refinement (XenoCollide: G. Snethen, Game Programming Gems 7, 2008), made to answer only by
// proof.
//
// Let K = A - B; the bodies share a point exactly where K contains the origin. From a point v0 of K the search follows
// the ray through the origin: it finds a triangle of support points (v1, v2, v3), the portal, that the ray passes, and
// pushes it outwards one support point at a time. It needs the fewest support calls of all boolean queries measured
// (docs/decisions/0002-portal-refinement.md).
//
// There are two ways out that answer, and both are proofs in the presence of rounding:
//   - a support point w in a direction d with d . w below minus its rounding bound: d separates the bodies;
//   - the four determinants of (v0, v1, v2, v3) above their rounding bound: the simplex contains the origin.
// How the search chooses its next direction is not proven and need not be. Where it makes no progress beyond rounding,
// or runs into the cap, it says so and answers nothing.
//
// Written over lanes: every round makes one support call for the whole packet, whatever phase its lanes are in.
#pragma once

#include "engine/query/query_error.h"

namespace vex {

/// The end of a search, lane by lane: at most one of the first three masks is set; none means that it stalled, because
/// the origin is within rounding of the surface of K or of the plane of two points of the simplex with v0.
template <class L>
struct PortalResult {
  MaskOf<L> disjoint{false};
  MaskOf<L> overlap{false};
  MaskOf<L> capped{false};
  Vec3<L> separating_dir;   // where disjoint
  Vec3<L> v0, v1, v2, v3;   // points of K, up to QueryError::support; where overlap, a simplex around the origin
  int n_support_calls = 0;  // of the packet
};

namespace detail {

/// An oriented triangle's plane: (b - a) x (c - a), from the two shorter edges. Of a sliver the long edges are nearly
/// parallel, and their product would drown in its rounding.
template <class L>
struct Face {
  Vec3<L> normal;
  L edge_product;  // |e|_1 |f|_1 of the two edges; the normal is off by at most 4 u times this (E7)
};

template <class L>
Face<L> face_of(const Vec3<L>& a, const Vec3<L>& b, const Vec3<L>& c) {
  const Vec3<L> ab = b - a, bc = c - b, ca = a - c;
  const L length_ab = norm_1(ab), length_bc = norm_1(bc), length_ca = norm_1(ca);
  const MaskOf<L> omits_ab = both(length_ab > length_bc, length_ab > length_ca);
  const MaskOf<L> omits_bc = but_not(length_bc > length_ca, omits_ab);
  // ab x bc = bc x ca = ca x ab
  const Vec3<L> e = select<L>(omits_ab, bc, select<L>(omits_bc, ca, ab));
  const Vec3<L> f = select<L>(omits_ab, ca, select<L>(omits_bc, ab, bc));
  const L product =
      select(omits_ab, length_bc * length_ca, select(omits_bc, length_ca * length_ab, length_ab * length_bc));
  return {cross(e, f), product};
}

/// More than underflow can take from a dot product of a normal, for points up to 2^330 (E14).
inline constexpr double kUnderflow = 0x1p-700;

/// The plane of the face passes the origin at more than the points' own error, with the origin behind it (E7); `point`
/// is any of its corners.
template <class L>
MaskOf<L> has_origin_behind(const Face<L>& face, const Vec3<L>& point, const QueryError<L>& error) {
  const L rounding = L(8.0 * unit_roundoff<L>()) * (face.edge_product * norm_1(point));
  const L area = norm_1(face.normal) + L(4.0 * unit_roundoff<L>()) * face.edge_product;
  return dot(face.normal, point) > L(1.0 + 0x1p-40) * (rounding + error.support * area) + L(kUnderflow);
}

/// The simplex contains the origin, proven: every face has it behind by more than the points' own error.
template <class L>
MaskOf<L> proves_overlap(const Vec3<L>& v0, const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& v3,
                         const Face<L>& portal, const QueryError<L>& error) {
  const MaskOf<L> first = both(has_origin_behind(portal, v1, error), has_origin_behind(face_of(v0, v3, v2), v2, error));
  if (!any(first)) return first;
  return both(first, both(has_origin_behind(face_of(v0, v1, v3), v3, error),
                          has_origin_behind(face_of(v0, v2, v1), v1, error)));
}

}  // namespace detail

/// Searches K = `difference` for the origin. `v0`: a point of K, better deep inside; lengths up to 2^330.
/// `max_support_calls`: where to give up. Without `kProven` the signs are believed as they are computed: only for
/// measuring what the proofs cost.
template <class L, class Difference, bool kProven = true>
PortalResult<L> refine_portal(const Difference& difference, const Vec3<L>& v0, const QueryError<L>& error,
                              int max_support_calls) {
  using Mask = MaskOf<L>;
  PortalResult<L> result;
  // Points of K from the start, so that they are whatever round the search ends in.
  Vec3<L> v1 = v0, v2 = v0, v3 = v0;
  Vec3<L> dir = -v0;
  Mask active(true);
  // What the next support point will be; a lane in none of these is discovering its portal.
  Mask awaits_v1(true), awaits_v2(false), refining(false);

  while (any(active)) {
    if (result.n_support_calls == max_support_calls) {
      result.capped = active;
      break;
    }
    ++result.n_support_calls;
    L dir_length = norm_1(dir);
    if (any(either(dir_length<L(0x1p-100), dir_length> L(0x1p100)))) {
      dir = scaled_to_unit_exponent(dir);
      dir_length = norm_1(dir);
    }
    const Vec3<L> w = difference.support(dir);
    const L slack = kProven ? error.support * dir_length : L(0.0);
    const L value = dot(dir, w);
    const Mask separated = both(active, value < -slack);
    if (any(separated)) {
      result.disjoint = either(result.disjoint, separated);
      result.separating_dir = select<L>(separated, dir, result.separating_dir);
      active = but_not(active, separated);
      if (!any(active)) break;
    }
    // A direction of no length, or a NaN, leads nowhere.
    active = both(active, dir_length > L(0.0));

    const Mask got_v1 = awaits_v1;
    const Mask got_v2 = awaits_v2;
    const Mask got_v4 = refining;
    const Mask got_v3 = negation(either(either(got_v1, got_v2), got_v4));

    if (any(got_v4)) {
      // w is v4, in front of the portal. If it is not, beyond rounding, the portal lies in the surface of K: a stall.
      const Mask advances = (value - dot(dir, v1)) > slack;
      active = both(active, either(negation(got_v4), advances));
      // The planes through v0, the origin and v4 split the portal in three; the ray passes one of the parts.
      const Vec3<L> w_v0 = cross(w, v0);
      const Mask past_1 = dot(v1, w_v0) > L(0.0);
      const Mask past_2 = dot(v2, w_v0) > L(0.0);
      const Mask past_3 = dot(v3, w_v0) > L(0.0);
      const Mask replaces_3 = but_not(past_1, past_2);
      const Mask replaces_2 = but_not(past_3, past_1);
      const Mask replaces_1 = negation(either(replaces_2, replaces_3));
      v1 = select<L>(both(got_v4, replaces_1), w, v1);
      v2 = select<L>(both(got_v4, replaces_2), w, v2);
      v3 = select<L>(both(got_v4, replaces_3), w, v3);
    }
    if (any(got_v3)) {
      // Does the ray pass between the half planes (v0; v1, v3) and (v0; v3, v2)? If not, v3 takes the place of the
      // vertex on the far side, and the wedge turns.
      v3 = select<L>(got_v3, w, v3);
      const Mask outside_13 = both(got_v3, dot(cross(v1, v3), v0) < L(0.0));
      const Mask outside_32 = but_not(both(got_v3, dot(cross(v3, v2), v0) < L(0.0)), outside_13);
      v2 = select<L>(outside_13, v3, v2);
      v1 = select<L>(outside_32, v3, v1);
      const Mask turns = either(outside_13, outside_32);
      dir = select<L>(turns, cross(v1 - v0, v2 - v0), dir);
      refining = either(refining, but_not(got_v3, turns));
    }
    if (any(got_v2)) {
      // The wedge v0, v1, v2, oriented so that its normal points to the origin's side.
      const Vec3<L> normal = cross(v1 - v0, w - v0);
      const Mask flips = both(got_v2, dot(normal, v0) > L(0.0));
      v2 = select<L>(got_v2, select<L>(flips, v1, w), v2);
      v1 = select<L>(flips, w, v1);
      dir = select<L>(got_v2, select<L>(flips, -normal, normal), dir);
      awaits_v2 = but_not(awaits_v2, got_v2);
    }
    if (any(got_v1)) {
      v1 = select<L>(got_v1, w, v1);
      dir = select<L>(got_v1, cross(w, v0), dir);
      awaits_v2 = either(awaits_v2, got_v1);
      awaits_v1 = but_not(awaits_v1, got_v1);
    }
    if (any(refining)) {
      const detail::Face<L> portal = detail::face_of(v1, v2, v3);
      dir = select<L>(refining, portal.normal, dir);
      const Mask behind = both(both(active, refining), dot(portal.normal, v1) > L(0.0));
      if (any(behind)) {
        Mask inside = behind;
        if constexpr (kProven) inside = both(behind, detail::proves_overlap(v0, v1, v2, v3, portal, error));
        result.overlap = either(result.overlap, inside);
        result.v1 = select<L>(inside, v1, result.v1);
        result.v2 = select<L>(inside, v2, result.v2);
        result.v3 = select<L>(inside, v3, result.v3);
        active = but_not(active, inside);
      }
    }
  }
  result.v0 = v0;
  result.v1 = select<L>(result.overlap, result.v1, v1);
  result.v2 = select<L>(result.overlap, result.v2, v2);
  result.v3 = select<L>(result.overlap, result.v3, v3);
  return result;
}

}  // namespace vex

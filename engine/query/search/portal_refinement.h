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
#pragma once

#include "engine/query/search/portal_split.h"
#include "engine/query/search/query_error.h"

namespace vex {

/// The end of a search; none of the first three means that it stalled, because the origin is within rounding of the
/// surface of K or of the plane of two points of the simplex with v0.
template <class L>
struct PortalResult {
  bool disjoint = false, overlap = false, capped = false;
  Vec3<L> separating_dir;  // where disjoint
  Vec3<L> v0, v1, v2, v3;  // points of K, up to QueryError::support; where overlap, a simplex around the origin
  int n_support_calls = 0;
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
  // ab x bc = bc x ca = ca x ab
  if (length_ab > length_bc && length_ab > length_ca) return {cross(bc, ca), length_bc * length_ca};
  if (length_bc > length_ca) return {cross(ca, ab), length_ca * length_ab};
  return {cross(ab, bc), length_ab * length_bc};
}

/// More than underflow can take from a dot product of a normal, for points up to 2^330 (E14).
inline constexpr double kUnderflow = 0x1p-700;

/// The plane of the face passes the origin at more than the points' own error, with the origin behind it (E7); `point`
/// is any of its corners.
template <class L>
bool has_origin_behind(const Face<L>& face, const Vec3<L>& point, const QueryError<L>& error) {
  const L rounding = L(8.0 * unit_roundoff<L>()) * (face.edge_product * norm_1(point));
  const L area = norm_1(face.normal) + L(4.0 * unit_roundoff<L>()) * face.edge_product;
  return dot(face.normal, point) > L(1.0 + 0x1p-40) * (rounding + error.support * area) + L(kUnderflow);
}

/// The simplex contains the origin, proven: every face has it behind by more than the points' own error.
template <class L>
bool proves_overlap(const Vec3<L>& v0, const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& v3, const Face<L>& portal,
                    const QueryError<L>& error) {
  return has_origin_behind(portal, v1, error) && has_origin_behind(face_of(v0, v3, v2), v2, error) &&
         has_origin_behind(face_of(v0, v1, v3), v3, error) && has_origin_behind(face_of(v0, v2, v1), v1, error);
}

}  // namespace detail

/// Searches K = `difference` for the origin. `v0`: a point of K, better deep inside; lengths up to 2^330.
/// `max_support_calls`: where to give up. Without `kProven` the signs are believed as they are computed: only for
/// measuring what the proofs cost.
template <class L, class Difference, bool kProven = true>
PortalResult<L> refine_portal(const Difference& difference, const Vec3<L>& v0, const QueryError<L>& error,
                              int max_support_calls) {
  PortalResult<L> result;
  // Points of K from the start, so that they are whatever round the search ends in.
  Vec3<L>&v1 = result.v1, &v2 = result.v2, &v3 = result.v3;
  result.v0 = v1 = v2 = v3 = v0;
  Vec3<L> dir = -v0;
  enum class Awaited { first, second, third, fourth } awaited = Awaited::first;  // what the next point will be: v1 ...

  while (true) {
    if (result.n_support_calls >= max_support_calls) {
      result.capped = true;
      return result;
    }
    ++result.n_support_calls;
    L dir_length = norm_1(dir);
    if (dir_length < L(0x1p-100) || dir_length > L(0x1p100)) {
      dir = scaled_to_unit_exponent(dir);
      dir_length = norm_1(dir);
    }
    const Vec3<L> w = difference.support(dir);
    const L slack = kProven ? error.support * dir_length : L(0.0);
    const L value = dot(dir, w);
    if (value < -slack) {
      result.disjoint = true;
      result.separating_dir = dir;
      return result;
    }
    // A direction of no length, or a NaN, leads nowhere.
    bool stalls = !(dir_length > L(0.0));

    switch (awaited) {
      case Awaited::first:
        v1 = w;
        dir = cross(w, v0);
        awaited = Awaited::second;
        break;
      case Awaited::second: {
        // The wedge v0, v1, v2, oriented so that its normal points to the origin's side.
        const Vec3<L> normal = cross(v1 - v0, w - v0);
        const bool flips = dot(normal, v0) > L(0.0);
        v2 = flips ? v1 : w;
        if (flips) v1 = w;
        dir = flips ? -normal : normal;
        awaited = Awaited::third;
        break;
      }
      case Awaited::third: {
        // Does the ray pass between the half planes (v0; v1, v3) and (v0; v3, v2)? If not, v3 takes the place of the
        // vertex on the far side, and the wedge turns.
        v3 = w;
        const bool outside_13 = dot(cross(v1, v3), v0) < L(0.0);
        const bool outside_32 = !outside_13 && dot(cross(v3, v2), v0) < L(0.0);
        if (outside_13) v2 = v3;
        if (outside_32) v1 = v3;
        if (outside_13 || outside_32) {
          dir = cross(v1 - v0, v2 - v0);
        } else {
          awaited = Awaited::fourth;
        }
        break;
      }
      case Awaited::fourth: {
        // If v4 is not in front of the portal, beyond rounding, the portal lies in the surface of K: a stall.
        stalls = stalls || !(value - dot(dir, v1) > slack);
        const PortalSplit<L> split = split_portal(v1, v2, v3, cross(w, v0));
        (split.beside_12 ? v3 : split.beside_31 ? v2 : v1) = w;
        break;
      }
    }
    if (stalls) return result;
    if (awaited != Awaited::fourth) continue;
    const detail::Face<L> portal = detail::face_of(v1, v2, v3);
    dir = portal.normal;
    if (!(dot(portal.normal, v1) > L(0.0))) continue;
    if (kProven && !detail::proves_overlap(v0, v1, v2, v3, portal, error)) continue;
    result.overlap = true;
    return result;
  }
}

}  // namespace vex

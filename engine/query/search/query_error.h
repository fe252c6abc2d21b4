// The rounding bounds that turn computed signs into proven ones: docs/derivations.md, E1.
#pragma once

#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// What a placed pair of bodies needs to know of its own roundings. Lengths; one value a lane.
template <class L>
struct QueryError {
  L reach;    // no point of A - B, computed or true, is farther than this from the origin
  L support;  // h(d) <= fl(d . w) + support * |d|_1 for w, the support point as computed; w is within this of A - B
};

/// E1. For a pose whose R is a rotation to within 1e-6, which is what poses are required to be.
template <class L>
QueryError<L> query_error(const ConvexBody& a, const ConvexBody& b, const Transform<L>& a_from_b) {
  const L reach = L(a.reach() + 2.0 * b.reach()) + norm_1(a_from_b.translation);
  const double own =
      a.core_support_error() + 2.0 * b.core_support_error() + 8.0 * kUnitRoundoff * (a.ball_radius() + b.ball_radius());
  return {reach, L(own) + L(40.0 * kUnitRoundoff) * reach};
}

/// Whether the sixth powers of the pair's lengths, and their products with directions, neither over- nor underflow
/// (E14): where they do, searches are of the pair times a power of two, or in twice the precision.
inline bool is_usual(const QueryError<double>& error) { return error.reach > 0x1p-150 && error.reach < 0x1p150; }

}  // namespace vex

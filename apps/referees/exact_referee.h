// Do two bodies share a point? In exact arithmetic, by other methods than the tests that it judges.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Whether `exact_outcome` knows this pair: box and box, ellipsoid and ellipsoid, capsule and capsule, and a sphere
/// with each of sphere, box, ellipsoid and capsule, in either order.
bool has_exact_outcome(const ConvexBody& a, const ConvexBody& b);

/// Disjoint, or overlap, which touching is; never undecided. About the input as docs/derivations.md defines it: a box
/// in B's place is the hull of its placed vertices, a curved body the exact set {R x + t}, a ball a ball. R may be any
/// invertible matrix. The pair must be one of the above.
Outcome exact_outcome(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b);

}  // namespace vex

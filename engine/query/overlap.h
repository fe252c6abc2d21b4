// Do two convex bodies share a point?
#pragma once

#include <array>
#include <span>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// What re-proves a verdict of `overlap`, in A's frame, lengths in the bodies' units.
struct OverlapCertificate {
  Vec3d separating_dir;          // of a disjoint verdict: every point of A is behind every point of B along it
  std::array<Vec3d, 4> simplex;  // of an overlap verdict: points of A - B, up to rounding, around the origin
  int n_support_calls = 0;       // support mappings of A - B evaluated, for any verdict
};

/// Decides whether A and B, placed by `a_from_b`, share a point; never guesses. No quick verdicts before it.
///
/// R of the pose must be a rotation to within 1e-6. Coordinates between 1e-45 and 1e45 in size. `certificate`, if
/// given, receives the proof. Undecided where the bodies touch to within rounding, about 1e-14 of their reach (E1).
Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                OverlapCertificate* certificate = nullptr);

}  // namespace vex

// The first stage of `overlap`: the search in double precision, which answers nearly all pairs by proof and the rest
// not at all. Its proofs hold whether or not the compiler fuses its operations (tests/regression/same_hits_test.cpp).
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Where a search starts, in units of the sum of the inradii from the difference of the centres: close to it, which
/// costs fewest support calls, but off every plane of symmetry.
inline constexpr Vec3d kStartOffset{0.01173, 0.02311, 0.03137};

/// Lengths that every support mapping takes. Of others the filter says nothing.
inline constexpr double kLeastLength = 0x1p-900, kLargestLength = 0x1p900;

struct FilterResult {
  Verdict verdict;
  Vec3d separating_dir;  // where disjoint
  int n_support_calls = 0;
};

/// `max_support_calls`: of each of three searches.
FilterResult filter_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                            int max_support_calls);

}  // namespace vex

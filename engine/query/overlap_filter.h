// The first stage of `overlap`: the search in double precision, which answers nearly all pairs by proof and the rest
// not at all. Its proofs hold whether or not the compiler fuses its operations (tests/regression/same_hits_test.cpp).
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

struct FilterResult {
  Verdict verdict;
  Vec3d separating_dir;  // where disjoint
  int n_support_calls = 0;
};

/// `max_support_calls`: of each of three searches.
FilterResult filter_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                            int max_support_calls);

}  // namespace vex

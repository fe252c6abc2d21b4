#include "tests/regression/fused_filter.h"

#include "tests/regression/same_hits_bodies.h"

namespace vex {

ConvexBody fused_body(SameHitsBody which) { return same_hits_body(which); }

FilterResult fused_filter_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                  int max_support_calls) {
  return filter_overlap(a, b, a_from_b, max_support_calls);
}

}  // namespace vex

// The engine's filter, compiled without its proofs: the same source, believing every sign. For measuring only.
#pragma once

#include "engine/query/overlap_filter.h"

namespace vex {

FilterResult filter_overlap_unproven(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                     int max_support_calls);

}  // namespace vex

// The filter and the support mappings of some bodies, compiled a second time with fused multiply-adds: a library of its
// own that shares no code with the rest.
#pragma once

#include "engine/query/search/overlap_filter.h"

#define VEX_FUSED __attribute__((visibility("default")))

namespace vex {

/// Pairs that the tests of equal hits run over: kinds of bodies by number.
enum class SameHitsBody { cube, slab, ellipsoid, cylinder, capsule, plate };

VEX_FUSED ConvexBody fused_body(SameHitsBody which);
VEX_FUSED FilterResult fused_filter_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                            int max_support_calls);

}  // namespace vex

// The engine's filter, compiled without its proofs: the same source, believing every sign. For measuring only.
#pragma once

#include "engine/query/packets/packet_overlap.h"
#include "engine/query/search/overlap_filter.h"

namespace vex {

FilterResult filter_overlap_unproven(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                     int max_support_calls);

/// The AVX2 kernel without its proofs.
#ifdef VEX_HAS_UNPROVEN_KERNEL
namespace unproven_kernel {
PacketOverlap* new_packet_overlap(const PacketPairForms& forms);
}
#endif

}  // namespace vex

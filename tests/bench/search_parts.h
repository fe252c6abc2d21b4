// What a packet's search is made of, by itself: how many support points it asks for, and what one takes.
#pragma once

#include <cstddef>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packets/packet_overlap.h"

namespace vex {

/// Of pairs whose cores are tables of directions.
struct SearchParts {
  /// Support points of A - B that the search asks for, of up to kMostTrials poses, whole packets counted.
  std::size_t (*n_supports)(const PacketPairForms& forms, const PoseTable& poses);
  /// A support point of A - B of each pose, along directions in three columns of the poses' stride, and whether it
  /// shows the bodies apart: of how many.
  std::size_t (*ask)(const PacketPairForms& forms, const PoseTable& poses, const double* directions);
};

/// Throws InputError where there is no kernel.
const SearchParts& search_parts(InstructionSet set);

#define VEX_SEARCH_PARTS(set)            \
  namespace set {                        \
  extern const SearchParts kSearchParts; \
  }
VEX_SEARCH_PARTS(sse2)
VEX_SEARCH_PARTS(avx2)
VEX_SEARCH_PARTS(avx512)
#undef VEX_SEARCH_PARTS

}  // namespace vex

// Which points of A - B a ray from the origin passes between first, of many poses and motions of one pair at once: the
// portals of ray_search.h, a register full of poses at a time, in double precision and without a proof. A search of one
// pose that begins there (cast_from_guess.h) has a few support calls left, and proves what it finds.
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/instruction_set.h"
#include "engine/query/cast_from_guess.h"
#include "engine/query/packets/packet_overlap.h"

namespace vex {

/// Of up to kMostPoses poses, one a row.
struct CastGuesses {
  static constexpr std::size_t kMostPoses = 32;
  static constexpr std::size_t kStride = kMostPoses + 16;  // with room for a packet

  alignas(64) double dirs[CastGuess::kMost][3][kStride];
  alignas(64) double n_dirs[kStride];

  CastGuess of(std::size_t row) const {
    CastGuess guess;
    guess.n = static_cast<std::size_t>(n_dirs[row]);
    for (std::size_t c = 0; c < guess.n; ++c) guess.dirs[c] = {dirs[c][0][row], dirs[c][1][row], dirs[c][2][row]};
    return guess;
  }
};

/// Poses and the rays' directions, three columns in a row of the poses' stride. `gap`: how far from a portal A - B may
/// be behind it.
using GuessCasts = void (*)(const PacketPairForms& forms, double gap, const PoseTable& poses, const double* motions,
                            CastGuesses& guesses);

/// Of `scalar` the one that is compiled for the baseline of the machine's kind. All guess the same, to the bit.
GuessCasts cast_guesser(InstructionSet set);

#define VEX_GUESS_CASTS(set)                                                                                \
  namespace set {                                                                                           \
  void guess_casts(const PacketPairForms& forms, double gap, const PoseTable& poses, const double* motions, \
                   CastGuesses& guesses);                                                                   \
  }
VEX_GUESS_CASTS(baseline)
VEX_GUESS_CASTS(sse2)
VEX_GUESS_CASTS(avx2)
VEX_GUESS_CASTS(avx512)
#undef VEX_GUESS_CASTS

}  // namespace vex

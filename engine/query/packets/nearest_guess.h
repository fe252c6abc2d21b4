// Where the point of A - B that is nearest to the origin may be, of many poses of one pair at once: a descent as that
// of nearest_descent.h, a register full of poses at a time, in double precision and without a proof. A search of one
// pose that begins there (separation_from_guess.h) has one or two support calls left, and proves what it finds.
#pragma once

#include <cstddef>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/separation_from_guess.h"

namespace vex {

/// Of up to kMostPoses poses, one a row.
struct NearestGuesses {
  static constexpr std::size_t kMostPoses = 32;
  static constexpr std::size_t kStride = kMostPoses + 16;  // with room for a packet
  static constexpr std::size_t kCorners = NearestGuess::kMost;

  bool are_points = false;
  // Of each corner the point of A, and that of B in B's frame; or the direction.
  alignas(64) double corners[kCorners][6][kStride];
  alignas(64) double weights[kCorners][kStride];  // 0: the simplex has no such corner

  NearestGuess of(std::size_t row) const {
    NearestGuess guess;
    guess.are_points = are_points;
    for (std::size_t c = 0; c < kCorners; ++c) {
      if (!(weights[c][row] > 0.0)) continue;
      const auto at = [&](std::size_t first) {
        return Vec3d{corners[c][first][row], corners[c][first + 1][row], corners[c][first + 2][row]};
      };
      guess.corners[guess.n++] = {at(0), are_points ? at(3) : Vec3d{}};
    }
    return guess;
  }
};

/// When a descent may end.
struct NearestGoal {
  double relative_gap;  // of the distance and `size`, between what a direction shows and how far the simplex is
  double size;
  bool wants_points;  // and no directions: of cores with vertices alone
  double farthest;    // cores that are farther apart need not be looked at any longer
};

using GuessNearest = void (*)(const PacketPairForms& forms, const NearestGoal& goal, const PoseTable& poses,
                              NearestGuesses& guesses);

/// Of `scalar` the one that is compiled for the baseline of the machine's kind. All guess the same, to the bit.
GuessNearest nearest_guesser(InstructionSet set);

#define VEX_GUESS_NEAREST(set)                                                                      \
  namespace set {                                                                                   \
  void guess_nearest(const PacketPairForms& forms, const NearestGoal& goal, const PoseTable& poses, \
                     NearestGuesses& guesses);                                                      \
  }
VEX_GUESS_NEAREST(baseline)
VEX_GUESS_NEAREST(sse2)
VEX_GUESS_NEAREST(avx2)
VEX_GUESS_NEAREST(avx512)
#undef VEX_GUESS_NEAREST

}  // namespace vex

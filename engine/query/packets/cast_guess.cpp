#include "engine/query/packets/cast_guess.h"

namespace vex {

GuessCasts cast_guesser(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::guess_casts;
#include "engine/numeric/kernel_sets.inc"
  return baseline::guess_casts;
}

}  // namespace vex

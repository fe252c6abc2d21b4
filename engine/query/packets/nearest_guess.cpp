#include "engine/query/packets/nearest_guess.h"

namespace vex {

GuessNearest nearest_guesser(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::guess_nearest;
#include "engine/numeric/kernel_sets.inc"
  return baseline::guess_nearest;
}

}  // namespace vex

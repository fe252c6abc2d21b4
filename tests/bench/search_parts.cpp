#include "tests/bench/search_parts.h"

#include "engine/numeric/errors.h"

namespace vex {

const SearchParts& search_parts(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::kSearchParts;
#include "engine/numeric/kernel_sets.inc"
  throw InputError("no kernels for this machine - nothing to show");
}

}  // namespace vex

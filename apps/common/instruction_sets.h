// Instruction sets as users name them.
#pragma once

#include <string>

#include "engine/numeric/instruction_set.h"

namespace vex {

/// scalar, sse2, avx2, avx512, or best; throws UsageError for another word, and where this machine or build has none.
InstructionSet instruction_set_named(const std::string& name);

}  // namespace vex

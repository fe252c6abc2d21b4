// Instruction sets as users name them.
#pragma once

#include <string>

#include "apps/common/option_parser.h"
#include "engine/numeric/instruction_set.h"

namespace vex {

/// Declares --isa. `kernels`: whose set it is.
void declare_instruction_set(OptionParser& options, std::string& word, const std::string& group,
                             const std::string& kernels = "the kernels");

/// scalar, sse2, avx2, avx512, or best, as no word is; throws UsageError for another word, and where this machine or
/// build has none.
InstructionSet instruction_set_named(const std::string& name);

}  // namespace vex

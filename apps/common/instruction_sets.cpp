#include "apps/common/instruction_sets.h"

#include "apps/common/choices.h"
#include "engine/numeric/errors.h"

namespace vex {

InstructionSet instruction_set_named(const std::string& name) {
  if (name == "best") return best_instruction_set();
  require_one_of(name, "--isa", {"best", "scalar", "sse2", "avx2", "avx512"});
  for (const InstructionSet set : instruction_sets()) {
    if (name_of(set) == name) return set;
  }
  throw UsageError("this machine or build has none (\"" + name + "\" for --isa) - its best is " +
                   std::string(name_of(best_instruction_set())));
}

}  // namespace vex

#include "apps/common/instruction_sets.h"

#include "apps/common/choices.h"
#include "engine/numeric/errors.h"

namespace vex {

void declare_instruction_set(OptionParser& options, std::string& word, const std::string& group,
                             const std::string& kernels) {
  options
      .add_option(
          "--isa", word,
          "Instruction set of " + kernels +
              ": scalar (none), sse2, avx2, avx512, or the best that this machine has (default); changes nothing "
              "but the time")
      .type_name("NAME")
      .group(group);
}

InstructionSet instruction_set_named(const std::string& name) {
  if (name.empty() || name == "best") return best_instruction_set();
  require_one_of(name, "--isa", {"best", "scalar", "sse2", "avx2", "avx512"});
  for (const InstructionSet set : instruction_sets()) {
    if (name_of(set) == name) return set;
  }
  throw UsageError("this machine or build has none (\"" + name + "\" for --isa) - its best is " +
                   std::string(name_of(best_instruction_set())));
}

}  // namespace vex

#include "apps/common/run_program.h"
#include "apps/modules/module.h"
#include "apps/ranks/program_ranks.h"

namespace vex {

std::unique_ptr<ProgramRanks> join_ranks() {
  if (n_copies_started() == 1) return nullptr;
  return std::unique_ptr<ProgramRanks>(
      reinterpret_cast<ProgramRanks* (*)()>(module_function("mpi", "vex_mpi_ranks"))());
}

}  // namespace vex

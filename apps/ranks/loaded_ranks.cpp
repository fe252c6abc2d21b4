#include <errno.h>  // program_invocation_short_name

#include <cstdlib>
#include <iostream>

#include "apps/common/run_program.h"
#include "apps/modules/module.h"
#include "apps/ranks/program_ranks.h"
#include "engine/numeric/errors.h"

namespace vex {

std::unique_ptr<ProgramRanks> join_ranks() {
  if (n_copies_started() == 1) return nullptr;
  try {
    return std::unique_ptr<ProgramRanks>(
        reinterpret_cast<ProgramRanks* (*)()>(module_function("mpi", "vex_mpi_ranks"))());
  } catch (const InputError& error) {
    // The first thing of main: nobody else would say it.
    std::cerr << program_invocation_short_name << ": " << error.what() << '\n';
    std::exit(kInputRefused);
  }
}

}  // namespace vex

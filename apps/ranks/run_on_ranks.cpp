#include "apps/common/run_program.h"
#include "apps/ranks/program_ranks.h"

namespace vex {

int run_on_ranks(ProgramRanks* ranks, OptionParser& options, int argc, char** argv,
                 const std::function<int()>& action) {
  const int code = run_program(
      options, argc, argv, [&] { return ranks == nullptr ? action() : ranks->run(action); }, ranks != nullptr);
  return ranks == nullptr ? code : ranks->leave(code);
}

}  // namespace vex

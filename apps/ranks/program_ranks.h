// A program that `mpirun -n K` started K times: one of them speaks for all.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "apps/common/option_parser.h"
#include "engine/sampling/ranks.h"

namespace vex {

class ProgramRanks : public Ranks {
 public:
  /// Who works with other bodies or settings than the leader must not take part: `identity` says what this rank works
  /// on. Before the run.
  virtual void introduce(const std::string& identity) = 0;
  /// Runs the program's action. What a rank that does not lead fails with is passed to the leader, who says it.
  virtual int run(const std::function<int()>& action) = 0;
  /// The last thing of main: waits for the others. Returns the exit code of this rank: the leader's is `code`.
  virtual int leave(int code) = 0;
};

/// Null where no launcher of MPI started this process with others, or this build is without MPI. From now on a rank
/// that does not lead prints nothing. The first thing of main.
std::unique_ptr<ProgramRanks> join_ranks();

/// `run_program` (run_program.h) on this rank of all; without ranks that alone. Returns the exit code of the process.
int run_on_ranks(ProgramRanks* ranks, OptionParser& options, int argc, char** argv, const std::function<int()>& action);

}  // namespace vex

// What every program's main does: parse, act, and turn failures into the documented exit codes.
#pragma once

#include <functional>
#include <string>

#include "apps/common/option_parser.h"

namespace vex {

enum ExitCode : int {
  kSuccess = 0,
  kFault = 1,         // of the program
  kWrongUsage = 2,
  kInputRefused = 3,  // unreadable, not closed, not convex, not finite, too large, without extent
  kDisagreement = 4,  // Monte Carlo and formula, by more than --max-z
  kSignalBase = 128,  // plus the signal that interrupted
};

/// What to say where standard output fails.
inline constexpr const char* kNoStandardOutput =
    "standard output cannot be written - look whether its disk is full or its reader has gone";

/// How many copies a launcher of MPI has started together, by what it tells its children; 1 without a launcher. 0: some,
/// and it does not say how many.
int n_copies_started();

/// The project's version, as CMake has it.
std::string version();

/// Parses the command line, then runs `action`, whose result is the exit code. Every failure becomes one line on
/// standard error, "vex_mesh: problem (where, which value) - what to do". `shares_work`: with the other copies that a
/// launcher of MPI started; where it does not, the first copy says so.
int run_program(OptionParser& options, int argc, char** argv, const std::function<int()>& action,
                bool shares_work = false);

/// The command line as a shell would take it back.
std::string command_line(int argc, char** argv);

}  // namespace vex

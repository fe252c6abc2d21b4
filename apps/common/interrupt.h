// Ctrl-C and termination: a run ends early, and what it found is still reported.
#pragma once

#include <atomic>
#include <string>

namespace vex {

/// From now on SIGINT and SIGTERM end the program at once, with the exit code that interrupted runs have: while bodies
/// are loaded there is nothing to report.
void end_on_interrupts(const std::string& program);

/// From now on SIGINT and SIGTERM set the number below instead of ending the program; a second one ends it at once,
/// with the exit code that interrupted runs have.
void catch_interrupts();

/// From now on SIGINT and SIGTERM end the program at once, without a word and with the exit code that interrupted runs
/// have: what is left to do may wait for others, such as for the reader of a pipe, and looks at no number. What is
/// ignored stays so.
void stop_catching_interrupts();

/// The signal that arrived, or 0.
const std::atomic<int>& interrupting_signal();

}  // namespace vex

// Signals: a run ends early, and what it found is still reported; or it goes on, and says how far it is.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace vex {

// SIGINT, SIGTERM, SIGHUP, SIGUSR2 (what schedulers send before they kill) and SIGXCPU (a limit on processor time) end
// a run; so does SIGXFSZ where somebody sends it, while a write beyond a limit on the size of files just fails. What is
// ignored when the program starts, as SIGHUP under nohup, stays so. SIGUSR1 asks how far the run is.

/// From now on these signals end the program at once, with the exit code that interrupted runs have: while bodies are
/// loaded there is nothing to report.
void end_on_interrupts(const std::string& program);

/// From now on they set the number below instead of ending the program. A second one ends it at once, with the same
/// exit codes, unless it comes within a fifth of a second: who sends a signal to a program and to its group, as timeout
/// does, means one. Nor does SIGXCPU, which comes again every second.
void catch_interrupts();

/// The signal that arrived, or 0.
const std::atomic<int>& interrupting_signal();

/// Writes "program: how far" on standard error if SIGUSR1 has asked since the last time. For loops to call; one thread
/// at a time answers, the others go on.
void answer_if_asked(const std::function<std::string()>& how_far);

/// As long as one lives no signal ends the program: there is a file that must not be left behind. One that would have
/// does so afterwards.
class EndHeldBack {
 public:
  EndHeldBack();
  ~EndHeldBack();
  EndHeldBack(const EndHeldBack&) = delete;
  EndHeldBack& operator=(const EndHeldBack&) = delete;
};

}  // namespace vex

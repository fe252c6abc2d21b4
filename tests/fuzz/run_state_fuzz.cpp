#include "run_state_fuzz.h"

#include <string>

#include "engine/numeric/errors.h"
#if __has_include("engine/sampling/run_state_text.h")
#include "engine/sampling/run_state_text.h"

namespace vex::tests {
namespace {

void read_state(std::string_view data) {
  RunState state;
  try {
    state = read_run_state(data);
  } catch (const InputError& error) {
    demand(std::string(error.what()).find(" - ") != std::string::npos, "the message ends in an advice");
    return;
  }
  const Tally& tally = state.done.tally;
  demand(tally.n_hits <= tally.n_trials && tally.n_undecided <= tally.n_trials - tally.n_hits, "trials add up");
  demand(state.end() >= state.first_trial, "trials have numbers");
  demand(state.seconds >= 0.0 && state.domain_volume >= 0.0, "times and volumes are none or more");
  // What was read is what is written.
  const std::string text = run_state_text(state);
  demand(run_state_text(read_run_state(text)) == text, "a state comes back");
  // And what follows it, if that is as it ends, can be added to it.
  RunState next;
  next.first_trial = state.end();
  try {
    state.append(std::move(next));
  } catch (const InputError&) {
    // Another way of counting.
  }
}

}  // namespace

std::vector<FuzzFormat> run_state_formats() { return {{"run-state", read_state}}; }

}  // namespace vex::tests
#else
std::vector<vex::tests::FuzzFormat> vex::tests::run_state_formats() { return {}; }
#endif

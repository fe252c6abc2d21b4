// A run's state as text: what checkpoints hold, what results are merged from, and what ranks send to each other.
#pragma once

#include <string>
#include <string_view>

#include "engine/sampling/run_state.h"

namespace vex {

/// Lines of words, the first of which is "vex-run-state" and the number of this format. Whole numbers stand in full,
/// sums as hexadecimal digits times a power of two, doubles as hexadecimal floating point: nothing is rounded. Some
/// hundred bytes of random points, three thousand of Sobol' points or strata; trials that are listed by index add
/// theirs.
std::string run_state_text(const RunState& state);

/// Reads it back. Throws InputError, which names the line, for any text that `run_state_text` does not write, and for
/// numbers that no run can have: counts that do not add up, sums that are no sums of so many shares.
RunState read_run_state(std::string_view text);

}  // namespace vex

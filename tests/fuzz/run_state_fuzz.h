// The state of a run, as checkpoints hold it and results are merged from it.
#pragma once

#include <vector>

#include "reader_fuzz.h"

namespace vex::tests {

/// "run-state".
std::vector<FuzzFormat> run_state_formats();

}  // namespace vex::tests

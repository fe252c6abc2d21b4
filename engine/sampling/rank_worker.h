// The part of a run on a rank that does not lead.
#pragma once

#include "engine/sampling/runner_factory.h"

namespace vex {

/// Makes blocks that the leader gives until it says that the run is over, on the threads of the settings. While they
/// make one block another one is asked for, so that nobody waits for a message. Throws what a backend throws.
void work_for_leader(RunnerFactory& factory, const MonteCarloSettings& settings);

}  // namespace vex

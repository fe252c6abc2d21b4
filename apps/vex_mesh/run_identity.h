// What a run of vex_mesh is of, in lines that are equal where two runs make the same trials.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_mesh/mesh_run.h"
#include "apps/vex_mesh/options.h"

namespace vex {

/// All that a trial of a given number depends on: versions, bodies, law, seed, estimator and its settings. Not where it
/// ends, nor threads or instruction sets.
std::vector<std::string> trials_identity(const MeshRun& run);

/// That, and of the stop rule what a run that goes on must have had from the beginning to end as one without a break:
/// all but the number of trials and the time.
std::vector<std::string> run_identity(const MeshRun& run);

/// The file that --checkpoint writes.
std::string checkpoint_text(const MeshRun& run, const RunState& state);
/// What --resume reads. Throws InputError.
RunState read_checkpoint(const std::string& path, const MeshRun& run);

}  // namespace vex

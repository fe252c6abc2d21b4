// What the reports of a run ask of it.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_mesh/mesh_run.h"

namespace vex {

/// The run's backend, then those that check it.
std::vector<std::string> backend_names(const MeshRun& run);

bool samples_poses(const MeshRun& run);
bool runs_gjk(const MeshRun& run);
bool has_trials(const MeshRun& run);
double relative_error_of(const MeshRun& run);

/// By how much a trial of this run took longer than it was counted to: costs are counted in nanoseconds of some
/// machine, the same everywhere, and the run tells what such a nanosecond is here.
double pace_of(const MeshRun& run);

/// What the run's error cost, or would have cost with another estimator; on as many threads.
double seconds_of(const Candidate& candidate, const MeshRun& run);

/// <V_ex> of the bodies of the control variate, by the formula.
double control_mean(const MeshRun& run);

}  // namespace vex

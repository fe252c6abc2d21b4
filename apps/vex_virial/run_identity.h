// What a run of vex_virial is of, and how far it came: what it saves, and goes on from.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_virial/report.h"

namespace vex {

/// All that a trial of a given number depends on: versions, bodies, law, seed. Not how many coefficients there are, nor
/// where their runs end.
std::vector<std::string> trials_identity(const VirialRun& run);

/// That, and of the stop rules what a run that goes on must have had from the beginning.
std::vector<std::string> run_identity(const VirialRun& run);

/// The file that --checkpoint writes: the states of the coefficients that the run came to.
std::string checkpoint_text(const VirialRun& run, const std::vector<RunState>& states);
/// What --resume reads. Throws InputError.
std::vector<RunState> read_checkpoint(const std::string& path, const VirialRun& run);

}  // namespace vex

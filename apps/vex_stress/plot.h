// The picture of a run of vex_stress.
#pragma once

#include <string>

#include "apps/vex_stress/report.h"

namespace vex {

/// SVG: a cell for each stratum and backend, coloured by the share of wrong answers, or of undecided ones where none is
/// wrong.
std::string picture_of(const StressRun& run);

}  // namespace vex

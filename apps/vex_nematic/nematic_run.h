// A body's coexisting fluids, and what is said of them.
#pragma once

#include <string>

#include "apps/common/bodies.h"
#include "apps/vex_nematic/options.h"
#include "shapes/estimators/nematic_transition.h"

namespace vex {

struct NematicRun {
  std::string command;
  NematicOptions options;
  LoadedBody body;
  NematicTransition found{};
  double seconds = 0.0;
};

/// Throws InputError where V_ex(gamma) is 0 or would take too long.
NematicRun run_nematic(const NematicOptions& options, const std::string& command);

std::string report_text(const NematicRun& run);
std::string report_json(const NematicRun& run);
/// --plot
std::string picture_of(const NematicRun& run);

}  // namespace vex

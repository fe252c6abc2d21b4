// The coexisting fluids of two kinds of bodies, and what is said of them.
#pragma once

#include <string>

#include "apps/common/bodies.h"
#include "apps/vex_nematic/options.h"
#include "shapes/estimators/nematic_transition.h"

namespace vex {

struct NematicMixtureRun {
  std::string command;
  NematicOptions options;
  LoadedBody a, b;
  MixtureTransition found{};
  double seconds = 0.0;
};

/// Throws InputError where a V_ex(gamma) is 0 or would take too long.
NematicMixtureRun run_mixture(const NematicOptions& options, const std::string& command);

std::string report_text(const NematicMixtureRun& run);
std::string report_json(const NematicMixtureRun& run);

}  // namespace vex

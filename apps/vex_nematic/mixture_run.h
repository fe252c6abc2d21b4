// The coexisting fluids of two kinds of bodies, and what is said of them.
#pragma once

#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_nematic/options.h"
#include "shapes/nematic/mixture.h"

namespace vex {

struct NematicMixtureRun {
  std::string command;
  NematicOptions options;
  LoadedBody a, b;
  NematicMixture mixture{};
  MixtureResult result{};
  double seconds = 0.0;

  /// Share of the volume that both kinds take; NaN where a body is flat.
  double volume_fraction(const MixturePhase& phase) const;
  /// n <V_ex> / 2, <V_ex> the mean over all pairs of the fluid.
  double reduced_density(const MixturePhase& phase) const;
};

/// Throws InputError where a V_ex(gamma) is 0 or would take too long.
NematicMixtureRun run_mixture(const NematicOptions& options, const std::string& command);

std::string report_text(const NematicMixtureRun& run);
std::string report_json(const NematicMixtureRun& run);

}  // namespace vex

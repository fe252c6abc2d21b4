// A body's coexisting fluids, and what is said of them.
#pragma once

#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_nematic/options.h"

namespace vex {

struct NematicRun {
  std::string command;
  NematicOptions options;
  LoadedBody body;
  double excluded_volume = 0.0;  // <V_ex>, isotropic: length^3
  NematicFluid fluid{};
  CoexistenceResult result{};
  std::vector<std::string> notes{};  // what a reader should know of the body or of the numbers
  double seconds = 0.0;

  double volume() const { return body.shape.measures.volume; }
  /// c = n b
  double b() const { return 0.5 * excluded_volume; }
};

/// V_ex(gamma) / <V_ex> of two bodies, the mean of gamma and 180 degrees - gamma, and <V_ex>.
struct EvenPart {
  EvenSeries series;
  double excluded_volume = 0.0;
  double largest_odd = 0.0;  // coefficient that is left out, over <V_ex>
};
/// Throws InputError where V_ex(gamma) is 0, overflows, or would take too long.
EvenPart even_part_of(const LoadedBody& a, const LoadedBody& b);

/// Throws InputError where V_ex(gamma) is 0 or would take too long.
NematicRun run_nematic(const NematicOptions& options, const std::string& command);

std::string report_text(const NematicRun& run);
std::string report_json(const NematicRun& run);
/// --plot
std::string picture_of(const NematicRun& run);

}  // namespace vex

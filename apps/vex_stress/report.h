// What vex_stress says: a table on the screen, and JSON.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_stress/measure.h"
#include "apps/vex_stress/options.h"

namespace vex {

/// All that is reported.
struct StressRun {
  std::string command;
  StressOptions options;
  std::vector<StressRow> rows{};
  bool complete = true;
  double seconds = 0.0;

  /// The counts of a backend over all rows.
  StressCounts total(std::size_t backend) const;
};

/// The document of --json.
std::string report_json(const StressRun& run);
std::string report_text(const StressRun& run);
/// The strata, their bodies, and nothing measured.
std::string list_text(const StressOptions& options);

}  // namespace vex

// What vex_mesh says of a run: on the screen and in JSON.
#pragma once

#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_mesh/options.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {

/// All that is reported.
struct MeshRun {
  std::string command;
  Options options;
  LoadedBody a, b;
  std::vector<LoadedBody> control_bodies{};  // of a control variate: of both, or one for each
  std::vector<std::string> left_out{};       // of a cross-check: why a backend does not take part
  ExcludedVolume result{};
};

/// The document of --json.
std::string report_json(const MeshRun& run);
std::string report_text(const MeshRun& run);

}  // namespace vex
